# SPDX-License-Identifier: BSD-3-Clause
"""Matching of object layouts: where is a local map in a global one, without a prior pose?"""

import os
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .compact import _Compact
from .inputs import _NONE, array, checked, label_list, per_detection
from .options import Options, settings
from .results import MapObject, MatchResult


@dataclass(frozen=True, eq=False, repr=False)
class Layout(_Compact):
    """N objects in gravity-aligned axes: x forward, y left, z up, origin anywhere. Arrays are
    checked when it is made."""

    labels: Tuple[str, ...]  #: N class names
    positions: np.ndarray  #: [N, 3] centres [m]
    yaws: np.ndarray = _NONE  #: [N] headings about z; NaN: unknown; None: all unknown [rad]
    dims: np.ndarray = _NONE  #: [N, 3] length, width, height; zero: unknown; None: all unknown [m]
    symmetries: Tuple[str, ...] = _NONE  #: N of "none", "pi", "full"; None: all "none"

    ids: np.ndarray = _NONE  #: [N] of the landmarks, in a place query; None: 0 to N - 1

    def __post_init__(self) -> None:
        labels = label_list(self.labels)
        count = len(labels)
        made: Dict[str, Any] = {
            "labels": labels,
            "positions": per_detection("positions", self.positions, count, (3,)),
            "yaws": (
                np.full(count, np.nan)
                if self.yaws is None
                else per_detection("yaws", self.yaws, count, ())
            ),
            "dims": (
                np.zeros((count, 3))
                if self.dims is None
                else per_detection("dims", self.dims, count, (3,))
            ),
            "symmetries": (
                ("none",) * count if self.symmetries is None else label_list(self.symmetries)
            ),
        }
        per_detection("symmetries", np.zeros(len(made["symmetries"])), count, ())
        made["ids"] = np.arange(count) if self.ids is None else self.ids
        made["ids"] = per_detection("ids", made["ids"], count, (), np.int32)
        for name, value in made.items():
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.labels)

    @staticmethod
    def of_objects(
        objects: Sequence[MapObject],
        labels: Optional[Mapping[str, str]] = None,
        up: ArrayLike = (0.0, -1.0, 0.0),
    ) -> "Layout":
        """The confirmed objects of a map. labels: symmetry by label. up: [3] the map's up
        direction."""
        axes = _core.gravity_axes(array("up", up, (3,)))  # columns forward, left, up
        seen = [each for each in objects if each.state == "confirmed"]
        T = np.array([each.T_world_object for each in seen]).reshape(-1, 4, 4)
        heading = T[:, :3, 0] @ axes
        make: Any = Layout
        return make(
            [each.label for each in seen],
            T[:, :3, 3] @ axes,
            np.arctan2(heading[:, 1], heading[:, 0]),
            np.array([each.dims for each in seen]).reshape(-1, 3),
            [(labels or {}).get(each.label, "none") for each in seen],
        )


@dataclass(frozen=True, eq=False, repr=False)
class PlaceQuery(_Compact):
    """What a place matcher is asked: find the recently seen objects among those of older passes.
    Both layouts are in the axes of the current world, so they differ by the drift; heights are
    relative to the camera; labels are numbers as texts, the same in both."""

    local: Layout
    global_: Layout
    frame: int  #: number of the newest frame
    old_frame: int  #: number of the newest frame of the global layout


@dataclass(frozen=True, eq=False, repr=False)
class PlaceAnswer(_Compact):
    """The answer of a place matcher: matched objects, or an old frame and the relative pose, e.g.
    from images. With the latter, switch off what knows only objects: {"refine.enabled": False,
    "loop.adjust_keyframes": 0}."""

    matches: np.ndarray = _NONE  #: [M, 2] indices into the local and the global layout
    match_frame: int = -1  #: number of the old frame; -1: the answer has `matches`
    T_match_query: np.ndarray = _NONE  #: [4, 4] query camera in the match camera's frame [m]
    score: float = 0.0  #: higher is more certain
    accepted: bool = False  #: close a loop?

    def __post_init__(self) -> None:
        pairs = np.zeros((0, 2)) if self.matches is None else self.matches
        pose = np.eye(4) if self.T_match_query is None else self.T_match_query
        made: Dict[str, Any] = {
            "matches": per_detection("matches", pairs, len(np.atleast_1d(pairs)), (2,), np.int32),
            "match_frame": int(array("match_frame", self.match_frame, (), np.int32)),
            "T_match_query": array("T_match_query", pose, (4, 4)),
            "score": float(array("score", self.score, ())),
            "accepted": bool(self.accepted),
        }
        for name, value in made.items():
            object.__setattr__(self, name, value)


#: None: no place was found.
PlaceMatcher = Callable[[PlaceQuery], Optional[PlaceAnswer]]


def match(local: Layout, global_: Layout, options: Optional[Options] = None) -> MatchResult:
    """Searches the pose of the local layout in the global one and decides whether to accept it.

    Deterministic. Objects whose position is not finite are ignored.

    Args:
        local, global_: gravity-aligned layouts [m].
        options: nested dict with the keys of `loop.match` of a run and of `decision`, e.g.
            {"loop": {"match": {"reach_m": 3}}, "decision": {"min_margin": 2}}.
    """
    maps = checked("local", local, Layout), checked("global_", global_, Layout)
    return _core.match(*maps, settings(options))


def read_layout_pairs(path: Union[str, "os.PathLike[str]"]) -> List[Tuple[int, Layout, Layout]]:
    """Id, local and global layout of each pair in a file for `sslcd_run match`."""
    return _core.read_pairs(os.fspath(path))
