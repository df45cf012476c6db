# SPDX-License-Identifier: BSD-3-Clause
"""Recorded sequences, and offline runs over them."""

import os
from functools import cached_property
from typing import Any, Callable, Dict, Iterator, List, Optional, Union

import numpy as np

from . import _core
from .errors import UsageError
from .inputs import Camera, Frame, checked
from .layouts import PlaceMatcher
from .options import Options, settings
from .results import (
    AdjustmentSummary,
    FilterReport,
    Improvement,
    LoopClosure,
    MapObject,
    NoiseScale,
    PoseGraph,
    StageTimes,
    Trajectory,
)

Path = Union[str, "os.PathLike[str]"]


class Dataset:
    """A sequence in memory: `len(dataset)`, `dataset[i]` and iteration give its Frames.

    Ground truth is for evaluation only and never enters the frames.
    """

    def __init__(self, core: Any, path: str = "") -> None:
        self._core = core
        self.path = path  #: of its folder

    def __len__(self) -> int:
        return len(self._core)

    def __getitem__(self, i: int) -> Frame:
        if not -len(self) <= i < len(self):
            raise IndexError(f"frame {i} of {len(self)}")
        return self._core.frame(i % len(self))

    def __iter__(self) -> Iterator[Frame]:
        return (self[i] for i in range(len(self)))

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def format(self) -> str:
        """The detected format: "sequence", "kitti-tracking", "kitti-odometry" or "kitti-raw"."""
        return self._core.format

    @property
    def labels(self) -> Dict[str, str]:
        """Symmetry by label: the `labels` of a Mapper."""
        return self._core.labels()

    @property
    def up(self) -> np.ndarray:
        """[3] unit vector in the odometry's world: the `up` of a Mapper."""
        return self._core.up()

    @property
    def camera(self) -> Optional[Camera]:
        """The `camera` of a Mapper; None: no calibration."""
        return self._core.camera()

    @property
    def groundtruth(self) -> Optional[Trajectory]:
        """T_world_cam, if there is any; `frames` are row numbers."""
        return self._core.groundtruth()

    @property
    def warnings(self) -> List[str]:
        """Tolerated defects, one sentence each."""
        return list(self._core.warnings)


def load_dataset(
    path: Path,
    *,
    format: str = "auto",
    sequence: str = "",
    detections: Path = "",
    odometry: Path = "",
    groundtruth: Path = "",
    score: str = "auto",
    max_frames: int = 0,
) -> Dataset:
    """Loads a dataset folder (docs/formats.md).

    Args:
        path: the folder.
        format: "auto", "sequence", "kitti-tracking", "kitti-odometry" or "kitti-raw".
        sequence: e.g. "0007"; may be empty if there is only one.
        detections, odometry, groundtruth: files, relative to `path` or the current folder; empty:
            the format's standard place. Odometry and detections must exist: this package makes none
            from images (`sslcd_run detect` does).
        score: the meaning of the score column: "auto", "probability" or "logit".
        max_frames: load only the first ones; 0: all.

    Raises:
        BadInputError: with file and line.
        UsageError: if there is a choice to make.
    """
    if max_frames < 0:
        raise UsageError(f"max_frames is {max_frames}, must be at least 0")
    parts = {
        "format": format,
        "sequence": sequence,
        "detections": os.fspath(detections),
        "odometry": os.fspath(odometry),
        "groundtruth": os.fspath(groundtruth),
    }
    return Dataset(
        _core.load_dataset(os.fspath(path), parts, score, max_frames), os.path.abspath(path)
    )


class RunResult:
    """The result of an offline run."""

    def __init__(self, core: Any) -> None:
        self._core = core

    @cached_property
    def trajectory(self) -> Trajectory:
        """T_world_cam of every frame."""
        return self._core.trajectory()

    @cached_property
    def odometry(self) -> Trajectory:
        """T_odom_cam of every frame."""
        return self._core.odometry()

    @cached_property
    def objects(self) -> List[MapObject]:
        """All landmarks by id; the confirmed ones are the map."""
        return self._core.objects()

    @cached_property
    def loops(self) -> List[LoopClosure]:
        """All attempts to close a loop in order, also refused ones."""
        return self._core.loops()

    @cached_property
    def graph(self) -> PoseGraph:
        """Frames, metric odometry between them, and accepted loops."""
        return self._core.graph()

    @property
    def scale(self) -> float:
        """Metres per odometry metre."""
        return self._core.scale()

    @property
    def noise_scale(self) -> NoiseScale:
        """Learnt factors on the detector's noise."""
        return self._core.noise_scale()

    @property
    def filter(self) -> FilterReport:
        """Sums over all frames."""
        return self._core.filter()

    @property
    def refinement(self) -> AdjustmentSummary:
        """The optimisation of the whole map at the end."""
        return self._core.refinement()

    @property
    def improvement(self) -> Improvement:
        """Of the trajectory, by that optimisation."""
        return self._core.improvement()

    @property
    def timing(self) -> Dict[str, StageTimes]:
        """Times by stage."""
        return self._core.timing()

    @property
    def images_failed(self) -> int:
        """Images that `load_image` has returned None for."""
        return self._core.images_failed()

    def write(self, folder: Path) -> List[str]:
        """Writes the run folder of `sslcd_run run` (docs/formats.md), all files or none;
        metrics.json is empty. Returns the paths. Raises OutputError."""
        return self._core.write(os.fspath(folder))


def run(
    dataset: Dataset,
    options: Optional[Options] = None,
    *,
    progress: Optional[Callable[[int, int], Any]] = None,
    load_image: Optional[Callable[[str], Optional[np.ndarray]]] = None,
    place_matcher: Optional[PlaceMatcher] = None,
) -> RunResult:
    """Maps a whole dataset and refines the map at the end.

    The same as `sslcd_run run` on given odometry and detections. Deterministic. ctrl-C and
    exceptions of the functions end it.

    Args:
        dataset: of load_dataset().
        options: nested dict with the keys of docs/configuration.md.
        progress: called with the numbers of frames done and of all.
        load_image: returns the image of a path as uint8 [H, W, 3] in the order blue, green, red,
            e.g. cv2.imread, or None. It is called for frames with boxes whose dataset has images
            but no colours. None: no colours are measured.
        place_matcher: as of Mapper.
    """
    core = checked("dataset", dataset, Dataset)._core
    return RunResult(_core.run(core, settings(options), progress, load_image, place_matcher))
