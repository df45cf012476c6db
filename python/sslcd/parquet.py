# SPDX-License-Identifier: BSD-3-Clause
"""Maps as Parquet files, for pandas, DuckDB or Spark: `pip install 'sslcd[parquet]'`."""

import os
from typing import Any, Dict, List, Union

import numpy as np

from . import _core
from .map_results import MapResults
from .maps import Map

try:
    import pyarrow
    from pyarrow import parquet
except ImportError as problem:
    raise ImportError(
        f"sslcd.parquet needs pyarrow: pip install 'sslcd[parquet]' ({problem})"
    ) from problem

Columns = Dict[str, Any]


def write_parquet(map: Map, folder: Union[str, "os.PathLike[str]"]) -> List[str]:
    """Writes the results of a map as tables; returns the paths.

    | file | a row for each | columns |
    |---|---|---|
    | sessions.parquet | session | name, frames, frame_offset, dataset, started |
    | poses.parquet | frame | session, frame, stamp [s], x y z [m], qx qy qz qw (T_world_cam) |
    | landmarks.parquet | landmark | id, label, state, x y z [m], qx qy qz qw (T_world_object), |
    | | | length width height [m], sightings |
    | sightings.parquet | sighting | landmark, frame, detection |
    | loops.parquet | attempt | id, query_frame, match_frame, decision, reason, score [nats], ... |

    Frames have the numbers of the map. Each file is whole or missing.

    Raises:
        BadInputError: the file is no sound map.
        OutputError: a file cannot be written.
    """
    results = map.results
    tables = {
        "sessions": _sessions(map),
        "poses": _poses(results),
        "landmarks": _landmarks(results),
        "sightings": _sightings(results),
        "loops": _loops(results),
    }
    try:
        os.makedirs(folder, exist_ok=True)
        return [_write(os.path.join(folder, f"{name}.parquet"), tables[name]) for name in tables]
    except OSError as problem:
        from .errors import OutputError

        raise OutputError(f"{folder}: cannot be written: {problem}; name another folder") from None


def _write(path: str, columns: Columns) -> str:
    temporary = f"{path}.tmp-{os.getpid()}"
    try:
        parquet.write_table(pyarrow.table(columns), temporary)
        os.replace(temporary, path)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)
    return path


def _pose_columns(poses: np.ndarray) -> Columns:
    """x y z and the unit quaternion of poses [N, 4, 4]."""
    rows = _core.tum_text(np.arange(len(poses), dtype=float), poses).split()
    table = np.array(rows, dtype=float).reshape(-1, 8)
    return dict(zip(("x", "y", "z", "qx", "qy", "qz", "qw"), table[:, 1:].T))


def _sessions(map: Map) -> Columns:
    names = ("name", "frames", "frame_offset", "dataset", "started")
    return {name: [getattr(each, name) for each in map.sessions] for name in names}


def _poses(results: MapResults) -> Columns:
    paths = results.trajectories
    return {
        "session": [name for name, path in paths.items() for _ in path.frames],
        "frame": np.concatenate([np.zeros(0, int), *(path.frames for path in paths.values())]),
        "stamp": np.concatenate([np.zeros(0), *(path.stamps for path in paths.values())]),
        **_pose_columns(
            np.concatenate([np.zeros((0, 4, 4)), *(path.poses for path in paths.values())])
        ),
    }


def _landmarks(results: MapResults) -> Columns:
    objects = results.objects
    dims = np.array([each.dims for each in objects]).reshape(-1, 3)
    return {
        "id": [each.id for each in objects],
        "label": [each.label for each in objects],
        "state": [each.state for each in objects],
        **_pose_columns(np.array([each.T_world_object for each in objects]).reshape(-1, 4, 4)),
        **dict(zip(("length", "width", "height"), dims.T)),
        "sightings": [len(each.observations) for each in objects],
    }


def _sightings(results: MapResults) -> Columns:
    seen = np.concatenate([np.zeros((0, 2), int), *(o.observations for o in results.objects)])
    counts = [len(each.observations) for each in results.objects]
    ids = [each.id for each in results.objects]
    return {"landmark": np.repeat(ids, counts), "frame": seen[:, 0], "detection": seen[:, 1]}


def _loops(results: MapResults) -> Columns:
    names = ("id", "newest_frame", "query_frame", "match_frame", "decision", "reason", "score")
    more = ("second_score", "probability", "by_views", "viewpoint_change")
    return {name: [getattr(each, name) for each in results.loops] for name in names + more}
