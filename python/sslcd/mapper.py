# SPDX-License-Identifier: BSD-3-Clause
"""The streaming interface: frames in, map of objects and corrected trajectory out."""

from typing import Any, Dict, List, Mapping, Optional

from numpy.typing import ArrayLike

from . import _core
from .errors import UsageError
from .frame_taker import FrameTaker
from .inputs import Camera, array, checked
from .layouts import PlaceMatcher
from .options import Options, settings
from .results import (
    AdjustmentSummary,
    FrameReport,
    Improvement,
    LoopClosure,
    LoopSearchSummary,
    MapChanges,
    MapObject,
    MapPart,
    NoiseScale,
    PoseGraph,
    StageTimes,
    Trajectory,
)

KITTI_UP = (0.0, -1.0, 0.0)


def context(
    labels: Optional[Mapping[str, str]],
    up: ArrayLike,
    camera: Optional[Camera] = None,
    place_matcher: Optional[PlaceMatcher] = None,
) -> Dict[str, Any]:
    """The context of _core.Mapper."""
    if labels is not None and not isinstance(labels, Mapping):
        raise UsageError(f"labels is {labels!r}, expected a dict such as {{'Tree': 'full'}}")
    for label, symmetry in (labels or {}).items():
        if not isinstance(label, str) or not isinstance(symmetry, str):
            raise UsageError(f"labels has {label!r}: {symmetry!r}, expected texts")
    if camera is not None:
        checked("camera", camera, Camera)
    if place_matcher is not None and not callable(place_matcher):
        raise UsageError(f"place_matcher is {place_matcher!r}, expected a function")
    up = array("up", up, (3,))
    labels = dict(labels or {})
    return {"labels": labels, "up": up, "camera": camera, "place_matcher": place_matcher}


class Mapper(FrameTaker[FrameReport]):
    """Takes frames and builds a map of objects and a corrected trajectory.

    The world is the odometry's frame with metric scale; the first camera keeps its odometry pose.
    Long calls run without the GIL. Threads may share a mapper: their calls take turns.

    Args:
        options: nested dict with the keys of docs/configuration.md.
        labels: symmetry of each class about the vertical: "none" (front and back differ, as of a
            car), "pi" (they are equal, or not told apart) or "full" (no heading, as of a tree).
            Classes that are not named have "none".
        up: [3] the up direction in the odometry's world. KITTI cameras: (0, -1, 0); VINS worlds:
            (0, 0, 1).
        camera: projects cuboids, to compare them with 2D boxes; None: boxes are not used.
        place_matcher: a function that replaces sslcd's search for places (PlaceQuery). Its
            exceptions come out of the call that runs it.

    Raises:
        BadConfigError: with all problems of the options at once.
    """

    def __init__(
        self,
        options: Optional[Options] = None,
        *,
        labels: Optional[Mapping[str, str]] = None,
        up: ArrayLike = KITTI_UP,
        camera: Optional[Camera] = None,
        place_matcher: Optional[PlaceMatcher] = None,
    ) -> None:
        given = context(labels, up, camera, place_matcher)
        super().__init__(_core.Mapper(settings(options), given))

    def refine(self, at_end: bool = True) -> AdjustmentSummary:
        """Optimises poses, landmarks and scale over all frames so far, and searches loops a second
        time. The trajectory of the odometry stays where the result is not surely better
        (`improvement`). May be called at any time; takes seconds for thousands of frames.

        at_end: no frame follows, so the latest cameras search, too, with what they have seen.
        """
        return self._core.refine(bool(at_end))

    def take_changes(self) -> MapChanges:
        """What has changed since the last call or the last frame's report, e.g. by refine()."""
        return self._core.take_changes()

    def current(self, id: int) -> Optional[int]:
        """The landmark that an id names now: itself, or the one it was fused into. None: it was
        removed."""
        return self._core.current(id)

    def copy(self) -> "Mapper":
        """A mapper with its own state."""
        return _wrap(self._core.copy(), self._next_index)

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> "Mapper":
        return self.copy()

    @property
    def trajectory(self) -> Trajectory:
        """T_world_cam of all frames so far."""
        return self._core.trajectory()

    @property
    def objects(self) -> List[MapObject]:
        """All landmarks by id; the confirmed ones are the map."""
        return self._core.objects()

    @property
    def loops(self) -> List[LoopClosure]:
        """All attempts to close a loop in order, also refused ones, then the early loops."""
        return self._core.loops()

    @property
    def parts(self) -> List[MapPart]:
        """The parts of the run by number, and which of them have a common map."""
        return self._core.parts()

    @property
    def graph(self) -> PoseGraph:
        """Frames by their numbers, the metric odometry between them, and accepted loops."""
        return self._core.graph()

    @property
    def loop_search(self) -> LoopSearchSummary:
        """The attempts so far, and why there are no more loops."""
        return self._core.loop_search()

    @property
    def scale(self) -> float:
        """Metres per odometry metre."""
        return self._core.scale()

    @property
    def improvement(self) -> Improvement:
        """Of the trajectory, by the last refine()."""
        return self._core.improvement()

    @property
    def noise_scale(self) -> NoiseScale:
        """Learnt factors on the detector's noise."""
        return self._core.noise_scale()

    @property
    def timing(self) -> Dict[str, StageTimes]:
        """Times by stage."""
        return self._core.timing()


def _wrap(core: Any, next_index: int) -> Mapper:
    mapper = Mapper.__new__(Mapper)
    FrameTaker.__init__(mapper, core, next_index)
    return mapper
