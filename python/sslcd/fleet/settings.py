# SPDX-License-Identifier: BSD-3-Clause
"""What a build of a fleet depends on."""

import os
from dataclasses import asdict, dataclass, field
from typing import Any, Dict, List

from .. import _core
from ..errors import UsageError
from .content import digest

#: Changes when the outputs of the same inputs change, or the way they are stored.
OUTPUT_VERSION = 1


@dataclass(frozen=True)
class FleetSettings:
    """The same for all drives. Values are texts and numbers, so that they can be sent to workers."""

    #: `section.key=value`, as `sslcd_run --set` takes them
    options: List[str] = field(default_factory=list)
    #: arguments of load_dataset: format, sequence, detections, odometry, score. Files are relative to
    #: the folder of the drive, and in it
    dataset: Dict[str, str] = field(default_factory=dict)
    #: of the file system of the drives: fsspec's storage options, e.g. {"anon": True}
    storage: Dict[str, Any] = field(default_factory=dict)
    #: maps that a drive is compared with at most; 0: all others
    candidates: int = 10

    def files(self) -> Dict[str, str]:
        """The files that `dataset` names. Raises UsageError for one outside the drives: the names of
        the outputs do not depend on its content, so a change of it would not be seen."""
        names = ("detections", "odometry", "groundtruth")
        files = {name: str(self.dataset[name]) for name in names if self.dataset.get(name)}
        for name, file in files.items():
            if os.path.isabs(file) or ".." in file.split("/"):
                raise UsageError(
                    f"{name} {file}: is not in the folder of a drive; copy the file into each drive, "
                    "and give its name relative to that"
                )
        return files

    def key(self, *parts: Any) -> str:
        """The name of an output: of what it is made from, the options, and the version."""
        made_by = [OUTPUT_VERSION, _core.__version__, self.options, sorted(self.dataset.items())]
        return digest([made_by, list(parts)])

    def for_report(self) -> Dict[str, Any]:
        """All but the storage options, which may be secret."""
        return {name: value for name, value in asdict(self).items() if name != "storage"}
