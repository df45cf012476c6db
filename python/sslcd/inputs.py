# SPDX-License-Identifier: BSD-3-Clause
"""What goes into a mapper: frames and the camera."""

from dataclasses import dataclass, field
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np

from .errors import UsageError

_EMPTY: Any = ()  # defaults of fields that are arrays once the object is made
_NONE: Any = None
Step = Union[None, str, Tuple[float, float]]


def array(
    name: str, value: Any, shape: Tuple[Optional[int], ...], dtype: type = np.float64
) -> np.ndarray:
    """`value` as a C-contiguous array of this shape (None: any length), or UsageError."""
    if value is None:
        raise UsageError(f"{name} is None, expected numbers")
    whole = issubclass(dtype, np.integer)
    try:
        if np.iscomplexobj(value):
            raise TypeError("complex numbers")
        made: np.ndarray = np.asarray(value, dtype=np.float64 if whole else dtype, order="C")
    except (TypeError, ValueError, OverflowError) as problem:
        raise UsageError(f"{name} cannot be read as numbers: {problem}") from None
    if whole:
        if not (np.abs(made) < 2**31).all() or not (made == np.round(made)).all():
            raise UsageError(f"{name} has numbers that are not whole, or too large")
        made = made.astype(dtype)
    if np.ndim(value) != len(shape) or any(
        want not in (None, have) for want, have in zip(shape, made.shape)
    ):
        wanted = ", ".join("N" if length is None else str(length) for length in shape)
        raise UsageError(f"{name} has the shape {np.shape(value)}, expected ({wanted})")
    return made


def checked(name: str, value: Any, kind: type) -> Any:
    """`value`, or UsageError if it is of another class."""
    if not isinstance(value, kind):
        raise UsageError(f"{name} is {value!r}, expected a sslcd.{kind.__name__}")
    return value


def per_detection(
    name: str, value: Any, count: int, width: Tuple[Optional[int], ...], dtype: type = np.float64
) -> np.ndarray:
    """The same for an array with one row for each of `count` detections."""
    if count == 0 and value is not None and np.size(value) == 0:  # e.g. [] for no poses at all
        return np.zeros((0,) + tuple(length or 0 for length in width), dtype)
    made = array(name, value, (None,) + width, dtype)
    if len(made) != count:
        raise UsageError(f"{name} has {len(made)} rows, but there are {count} detections")
    return made


def label_list(labels: Any) -> Tuple[str, ...]:
    """The labels as a tuple of str. A lone text is refused: it would be read letter by letter."""
    if isinstance(labels, (str, bytes)):
        raise UsageError(
            f"labels is the text {labels!r}, expected one label for each detection: ['Car', 'Tree']"
        )
    try:
        made = tuple(labels)
    except TypeError:
        raise UsageError(f"labels is {labels!r}, expected one label for each detection") from None
    for label in made:
        if not isinstance(label, str):
            raise UsageError(f"labels has {label!r}, expected texts: number classes as str(number)")
    return tuple(map(str, made))  # of numpy.str_, too


@dataclass(frozen=True)
class Camera:
    """Rectified pinhole camera, into which cuboids are projected to compare them with 2D boxes."""

    fx: float  #: focal lengths and principal point [px]
    fy: float
    cx: float
    cy: float
    width: int = 0  #: [px]; 0: unknown, boxes are not clipped to the image then
    height: int = 0
    #: the reference camera's origin in this camera [m]
    offset: Tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        for name in ("fx", "fy", "cx", "cy"):
            array(f"Camera.{name}", getattr(self, name), ())
        for name in ("width", "height"):
            array(f"Camera.{name}", getattr(self, name), (), np.int32)
        array("Camera.offset", self.offset, (3,))


@dataclass(frozen=True, eq=False)
class Frame:
    """One input frame with N detections. Arrays are converted from whatever NumPy takes, and
    checked, when it is made.

    Axes of the camera are KITTI's: x right, y down, z forward. An object's frame has its origin in
    the centre of the cuboid, x along its length, y to its left, z up. Row i of each array is
    detection i.
    """

    index: int  #: number of the frame, increases
    stamp: float  #: [s]
    #: [4, 4] odometry: maps points of the camera to the odometry's world [m]
    T_odom_cam: np.ndarray
    labels: Tuple[str, ...] = ()  #: N class names
    poses: np.ndarray = _EMPTY  #: [N, 4, 4] T_cam_object [m]
    dims: np.ndarray = _EMPTY  #: [N, 3] length, width, height [m]
    scores: np.ndarray = _NONE  #: [N] probabilities in [0, 1]; None: all 1
    #: [N, 4] left, top, right, bottom [px]; a row without area or with NaN: none
    boxes: Optional[np.ndarray] = None
    #: [N, D] of a re-identification network; a row of zeros: none
    embeddings: Optional[np.ndarray] = None
    colours: Optional[np.ndarray] = None  #: [N, D] colour vectors; a row of zeros: none
    #: of the step from the frame before: None (nothing known), "lost" (tracking failed), or the
    #: standard deviations

    #: of its translation along each axis [m] and its rotation about each axis [rad]
    step: Step = None
    #: [N] numbers of the detections in MapObject.observations; None: 0 to N - 1
    rows: np.ndarray = _NONE
    image_left: str = ""  #: path of the image, for `run(load_image=...)`
    image_right: str = ""
    _same: Any = field(
        default=None, init=False, repr=False
    )  # of a Dataset: the same frame with all bits of its poses

    def __post_init__(self) -> None:
        labels = label_list(self.labels)
        count = len(labels)
        if isinstance(self.index, (bool, np.bool_)) or not isinstance(
            self.index, (int, np.integer)
        ):
            raise UsageError(f"index is {self.index!r}, expected a whole number")
        made: Dict[str, Any] = {
            "index": int(array("index", self.index, (), np.int32)),
            "stamp": float(array("stamp", self.stamp, ())),
            "T_odom_cam": array("T_odom_cam", self.T_odom_cam, (4, 4)),
            "labels": labels,
            "poses": per_detection("poses", self.poses, count, (4, 4)),
            "dims": per_detection("dims", self.dims, count, (3,)),
            "scores": (
                np.ones(count)
                if self.scores is None
                else per_detection("scores", self.scores, count, ())
            ),
            "rows": (
                np.arange(count)
                if self.rows is None
                else per_detection("rows", self.rows, count, (), np.int32)
            ),
            "step": _checked_step(self.step),
        }
        if self.boxes is not None:
            made["boxes"] = per_detection("boxes", self.boxes, count, (4,))
        for cue in ("embeddings", "colours"):
            if getattr(self, cue) is not None:
                made[cue] = per_detection(cue, getattr(self, cue), count, (None,), np.float32)
        for name, value in made.items():
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.labels)

    def __getstate__(self) -> Dict[str, Any]:
        return {
            **self.__dict__,
            "_same": None,
        }  # pickle and copy: the arrays say it all but for the last bits


def _checked_step(step: Step) -> Step:
    if step is None or (isinstance(step, str) and step == "lost"):
        return step
    if isinstance(step, str) or np.shape(step) != (2,):
        raise UsageError(
            f"step is {step!r}, expected None, 'lost' or (sigma_translation_m, sigma_rotation_rad)"
        )
    translation, rotation = array("step", step, (2,))
    return float(translation), float(rotation)
