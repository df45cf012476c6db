# SPDX-License-Identifier: BSD-3-Clause
"""How Mapper and AsyncMapper take frames."""

from typing import Any, Generic, Optional, Sequence, TypeVar

from numpy.typing import ArrayLike

from .inputs import Frame, Step, checked

Taken = TypeVar("Taken")
_frame: Any = Frame  # which takes what its fields are made of


class FrameTaker(Generic[Taken]):
    """Numbers frames and hands them to `_core`, whose answer is a `Taken`."""

    def __init__(self, core: Any, next_index: int = 0) -> None:
        self._core = core
        self._next_index = next_index

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
    ) -> Taken:
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

    def add(self, frame: Frame) -> Taken:
        """add_frame for a Frame, e.g. of a Dataset."""
        taken = self._core.add_frame(checked("frame", frame, Frame))
        self._next_index = frame.index + 1
        return taken

    def start_sequence(self) -> None:
        """The next frame begins a new sequence on the same map. Its stamp and pose may be any;
        loops join them."""
        self._core.start_sequence()
