# SPDX-License-Identifier: BSD-3-Clause
"""Recordings for the Rerun viewer: `pip install 'sslcd[rerun]'`."""

import os
from typing import Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from .inputs import array
from .results import LoopClosure, MapObject, Trajectory

try:
    import rerun
except ImportError as problem:
    raise ImportError(
        f"sslcd.rerun needs rerun-sdk: pip install 'sslcd[rerun]' ({problem})"
    ) from problem


def write_rrd(
    path: Union[str, "os.PathLike[str]"],
    trajectory: Trajectory,
    objects: Sequence[MapObject] = (),
    loops: Sequence[LoopClosure] = (),
    *,
    odometry: Optional[Trajectory] = None,
    up: ArrayLike = (0.0, -1.0, 0.0),
) -> None:
    """Writes a .rrd file: paths, confirmed objects as boxes, accepted loops as lines, and the
    camera at each frame on the timelines `frame` and `stamp`.

    Args:
        path: the file.
        trajectory, objects, loops: of a Mapper or a RunResult.
        odometry: is drawn as it is.
        up: [3] the up direction in the world of the trajectory: one of its axes.
    """
    recording = rerun.RecordingStream("sslcd")
    recording.save(os.fspath(path))
    recording.log("map", _view(array("up", up, (3,))), static=True)
    for name, line in (("odometry", odometry), ("trajectory", trajectory)):
        if line is not None:
            recording.log(f"map/{name}", rerun.LineStrips3D([line.positions]), static=True)
    _log_objects(recording, [each for each in objects if each.state == "confirmed"])
    _log_loops(recording, [each for each in loops if each.accepted], trajectory)
    for frame, stamp, pose in zip(trajectory.frames, trajectory.stamps, trajectory.poses):
        recording.set_time("frame", sequence=int(frame))
        recording.set_time("stamp", duration=float(stamp))
        camera = rerun.Transform3D(translation=pose[:3, 3], mat3x3=pose[:3, :3])
        recording.log("map/camera", camera)
    recording.flush()
    recording.disconnect()


def _view(up: np.ndarray) -> "rerun.ViewCoordinates":
    names = {0: "X", 1: "Y", 2: "Z"}
    axis = int(np.argmax(np.abs(up)))
    direction = "UP" if up[axis] > 0 else "DOWN"
    return getattr(rerun.ViewCoordinates, f"RIGHT_HAND_{names[axis]}_{direction}")


def _log_objects(recording: "rerun.RecordingStream", objects: Sequence[MapObject]) -> None:
    for label in sorted({each.label for each in objects}):
        mine = [each for each in objects if each.label == label]
        boxes = rerun.Boxes3D(
            centers=[each.T_world_object[:3, 3] for each in mine],
            half_sizes=[each.dims / 2 for each in mine],
            quaternions=[_quaternion(each.T_world_object[:3, :3]) for each in mine],
            labels=[f"{label} {each.id}" for each in mine],
        )
        recording.log(f"map/objects/{label}", boxes, static=True)


def _log_loops(
    recording: "rerun.RecordingStream", loops: Sequence[LoopClosure], trajectory: Trajectory
) -> None:
    place = dict(zip(trajectory.frames.tolist(), trajectory.positions))
    lines = [[place[each.match_frame], place[each.query_frame]] for each in loops]
    recording.log("map/loops", rerun.LineStrips3D(lines), static=True)


def _quaternion(R: np.ndarray) -> np.ndarray:
    """x y z w of a rotation; Shepperd's method by the largest component."""
    trace = np.trace(R)
    squares = np.array([*(2 * np.diag(R) - trace), trace])  # 4 q^2 - 1 of each component
    largest = int(np.argmax(squares))
    vector = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    if largest == 3:
        q = np.append(vector, 1 + trace)
    else:
        q = np.append(R[largest] + R[:, largest], vector[largest])
        q[largest] = 1 + squares[largest]
    return q / np.linalg.norm(q)
