# SPDX-License-Identifier: BSD-3-Clause
"""The streaming interface: frames in, map of objects and corrected trajectory out."""

import atexit
import weakref
from typing import Any, Dict, List, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .errors import UsageError
from .inputs import Camera, Frame, Step, array, checked
from .layouts import PlaceMatcher
from .options import Options, settings
from .results import (
    AdjustmentSummary,
    AsyncReport,
    FrameReport,
    Improvement,
    LoopClosure,
    LoopSearchSummary,
    MapChanges,
    MapObject,
    NoiseScale,
    PoseGraph,
    StageTimes,
    Trajectory,
)

KITTI_UP = (0.0, -1.0, 0.0)
_frame: Any = Frame  # which takes what its fields are made of


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


class Mapper:
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
        self._core = _core.Mapper(settings(options), given)
        self._next_index = 0

    def add_frame(
        self,
        stamp: float,
        T_odom_cam: ArrayLike,
        labels: Sequence[str] = (),
        poses: ArrayLike = (),
        dims: ArrayLike = (),
        scores: Optional[ArrayLike] = None,
        embeddings: Optional[ArrayLike] = None,
        colours: Optional[ArrayLike] = None,
        index: Optional[int] = None,
        step: Step = None,
        *,
        boxes: Optional[ArrayLike] = None,
    ) -> FrameReport:
        """Adds the next frame in order of time, with N detections.

        Args:
            stamp: [s].
            T_odom_cam: [4, 4] pose of the camera by odometry [m].
            labels: N class names.
            poses: [N, 4, 4] T_cam_object: centre of the cuboid, x along its length, y to its left,
                z up; axes of the camera: x right, y down, z forward [m].
            dims: [N, 3] length, width, height [m].
            scores: [N] probabilities in [0, 1]; None: all 1.
            embeddings: [N, D] of a re-identification network; a row of zeros: none.
            colours: [N, D] colour vectors; a row of zeros: none.
            index: number of the frame; None: one more than the last.
            step: of the step from the frame before: None, "lost" (tracking failed), or standard
                deviations of its translation and rotation [m, rad].
            boxes: [N, 4] left, top, right, bottom [px]; a row without area or with NaN: none.

        Raises:
            BadInputError: number or stamp does not increase, or a pose is not finite or no rigid
                transform; the mapper keeps its state. Detections with values that are not finite
                are no error: `report.filter.invalid` counts them.
            UsageError: arrays of other shapes.
        """
        number = self._next_index if index is None else index
        return self.add(
            _frame(
                number,
                stamp,
                T_odom_cam,
                labels,
                poses,
                dims,
                scores,
                boxes,
                embeddings,
                colours,
                step,
            )
        )

    def add(self, frame: Frame) -> FrameReport:
        """add_frame for a Frame, e.g. of a Dataset."""
        report = self._core.add_frame(checked("frame", frame, Frame))
        self._next_index = frame.index + 1
        return report

    def start_sequence(self) -> None:
        """The next frame begins a new sequence on the same map. Its stamp and pose may be any;
        loops join them."""
        self._core.start_sequence()

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
        """All attempts to close a loop in order, also refused ones."""
        return self._core.loops()

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
    mapper._core, mapper._next_index = core, next_index
    return mapper


# A thread that is in a place matcher must not outlive the interpreter.
_running: "weakref.WeakSet[AsyncMapper]" = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    for mapper in list(_running):
        mapper.close()


class AsyncMapper:
    """A Mapper on a thread of its own, for hosts that must not wait. Calls return at once but for
    wait() and snapshot(). All are thread-safe. `with AsyncMapper(...) as mapper:` closes it at the
    end.

    The arguments are those of Mapper; an exception of `place_matcher` ends the thread, and the
    report says so (`failure`). At most `most_waiting` frames wait; a frame that finds the
    queue full is dropped and counted, and the step to the next frame then spans it.

    A copy is refined on a second thread, while frames go on, and then gets the frames since. That
    begins by itself when a loop was accepted and the path has become longer by `refine_every_m`
    [m], and by a twentieth, since the last one began; 0: only by refine(). The result depends on
    the frames alone, unless some are dropped.
    """

    def __init__(
        self,
        options: Optional[Options] = None,
        *,
        labels: Optional[Mapping[str, str]] = None,
        up: ArrayLike = KITTI_UP,
        camera: Optional[Camera] = None,
        place_matcher: Optional[PlaceMatcher] = None,
        most_waiting: int = 64,
        refine_every_m: float = 50.0,
    ) -> None:
        given = context(labels, up, camera, place_matcher)
        most = int(array("most_waiting", most_waiting, (), np.int32))
        every_m = float(array("refine_every_m", refine_every_m, (), float))
        self._core = _core.AsyncMapper(settings(options), given, most, every_m)
        _running.add(self)
        self._next_index = 0

    def add_frame(
        self,
        stamp: float,
        T_odom_cam: ArrayLike,
        labels: Sequence[str] = (),
        poses: ArrayLike = (),
        dims: ArrayLike = (),
        scores: Optional[ArrayLike] = None,
        embeddings: Optional[ArrayLike] = None,
        colours: Optional[ArrayLike] = None,
        index: Optional[int] = None,
        step: Step = None,
        *,
        boxes: Optional[ArrayLike] = None,
    ) -> bool:
        """Hands in the next frame; arguments as of Mapper.add_frame. False: it was dropped, because
        the queue is full or the thread has failed. Arrays of wrong shapes raise here; what
        Mapper.add_frame raises for the frame's values is counted in the report."""
        number = self._next_index if index is None else index
        return self.add(
            _frame(
                number,
                stamp,
                T_odom_cam,
                labels,
                poses,
                dims,
                scores,
                boxes,
                embeddings,
                colours,
                step,
            )
        )

    def add(self, frame: Frame) -> bool:
        """add_frame for a Frame."""
        taken = self._core.add_frame(checked("frame", frame, Frame))
        self._next_index = frame.index + 1
        return taken

    def start_sequence(self) -> None:
        """Mapper.start_sequence for the next frame."""
        self._core.start_sequence()

    def refine(self, at_end: bool = True) -> None:
        """Mapper.refine after the frames handed in so far, on a second thread."""
        self._core.refine(bool(at_end))

    def snapshot(self) -> Mapper:
        """Waits for the frames handed in so far and returns a copy of the mapper. Raises
        NoSolutionError if the thread has failed."""
        return _wrap(self._core.snapshot(), self._next_index)

    def take_report(self) -> AsyncReport:
        """What was done since the last call."""
        return self._core.take_report()

    def wait(self) -> None:
        """Waits until all that was handed in is done. ctrl-C interrupts it."""
        self._core.wait()

    def close(self) -> None:
        """Ends the thread after the frame in work; what waits is not done. Other calls then raise
        UsageError."""
        self._core.close()

    @property
    def closed(self) -> bool:
        return self._core.closed()

    def __enter__(self) -> "AsyncMapper":
        return self

    def __exit__(self, *exception: Any) -> None:
        self.close()
