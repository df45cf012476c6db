# SPDX-License-Identifier: BSD-3-Clause
"""Retrieval: which of many maps is a stretch of a drive from?"""

import os
from typing import List, Mapping, Union

from . import _core
from .errors import UsageError
from .inputs import checked
from .layouts import Layout
from .results import SiteCandidate


class SiteIndex:
    """An index of many maps in a file (docs/scale.md). The file is mapped into memory and only read,
    so many processes share it. Threads may share one.

    Raises:
        BadInputError: the file is missing, damaged, or no index.
    """

    def __init__(self, path: Union[str, "os.PathLike[str]"]) -> None:
        self._core = _core.SiteIndex(os.fspath(path))

    @staticmethod
    def build(path: Union[str, "os.PathLike[str]"], sites: Mapping[str, Layout]) -> "SiteIndex":
        """Writes the index of some maps, as a whole or not at all. Heights and headings do not
        count. Layout.of_objects() makes the layout of a map. Raises OutputError."""
        for name, layout in sites.items():
            checked(name, layout, Layout)
        _core.build_site_index(list(sites), list(sites.values()), os.fspath(path))
        return SiteIndex(path)

    def __len__(self) -> int:
        return len(self._core)

    @property
    def objects(self) -> int:
        """Number of objects of all maps."""
        return self._core.objects()

    def find(self, stretch: Layout, most: int = 10) -> List[SiteCandidate]:
        """The maps that a stretch may be from, best first; none if nothing agrees. The stretch has
        the objects of about 100 m of path, seen from any side."""
        if most < 1:
            raise UsageError(f"most is {most}, must be at least 1")
        return self._core.find(checked("stretch", stretch, Layout), most)
