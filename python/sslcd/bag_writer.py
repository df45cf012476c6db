# SPDX-License-Identifier: BSD-3-Clause
"""Results as bags; sslcd.bags has write_bag()."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, Sequence, Union

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore

from .errors import OutputError, UsageError

if TYPE_CHECKING:
    from .bags import MappedBag


def write_bag(
    path: Union[str, "os.PathLike[str]"], mapped: "MappedBag", frame_id: str = "map"
) -> None:
    """Writes the corrected path (`/sslcd/path`, nav_msgs/Path), and loops and objects for RViz or
    Foxglove (`/sslcd/markers`, visualization_msgs/MarkerArray), at the stamp of the last frame.

    A path that ends in .bag is a ROS 1 bag, any other a folder of a ROS 2 bag with MCAP storage.
    It must not exist. Raises OutputError.
    """
    path = Path(path)
    if not frame_id:
        raise UsageError("frame_id is empty")
    if path.exists():
        raise OutputError(f"{path}: exists; remove it, or write to another place")
    ros1 = path.suffix == ".bag"
    types = get_typestore(Stores.ROS1_NOETIC if ros1 else Stores.LATEST)
    make = _Messages(types, frame_id, ros1)
    messages = (("/sslcd/path", make.path(mapped)), ("/sslcd/markers", make.markers(mapped)))
    serialize = types.serialize_ros1 if ros1 else types.serialize_cdr
    try:
        writer: Any = (
            Writer1(path) if ros1 else Writer2(path, version=9, storage_plugin=StoragePlugin.MCAP)
        )
        with writer:
            for topic, message in messages:
                kind = message.__msgtype__
                connection = writer.add_connection(topic, kind, typestore=types)
                writer.write(connection, int(mapped.stamps[-1]), serialize(message, kind))
    except OSError as problem:
        raise OutputError(f"{path}: {problem}") from problem


class _Messages:
    """Makes messages of a distribution of ROS."""

    def __init__(self, types: Typestore, frame_id: str, ros1: bool) -> None:
        self._types, self._frame_id, self._ros1 = types, frame_id, ros1

    def _make(self, kind: str, *values: Any) -> Any:
        return self._types.types[kind](*values)

    def _header(self, stamp: int) -> Any:
        time = self._make("builtin_interfaces/msg/Time", *divmod(int(stamp), 10**9))
        numbers = (0,) if self._ros1 else ()
        return self._make("std_msgs/msg/Header", *numbers, time, self._frame_id)

    def _pose(self, position: Sequence[float], orientation: Sequence[float]) -> Any:
        return self._make(
            "geometry_msgs/msg/Pose",
            self._make("geometry_msgs/msg/Point", *map(float, position)),
            self._make("geometry_msgs/msg/Quaternion", *map(float, orientation)),
        )

    def path(self, mapped: "MappedBag") -> Any:
        rows = [line.split() for line in mapped.path.tum().splitlines()]  # t x y z qx qy qz qw
        poses = [
            self._make(
                "geometry_msgs/msg/PoseStamped",
                self._header(stamp),
                self._pose([float(v) for v in row[1:4]], [float(v) for v in row[4:8]]),
            )
            for stamp, row in zip(mapped.stamps, rows)
        ]
        return self._make("nav_msgs/msg/Path", self._header(mapped.stamps[-1]), poses)

    def markers(self, mapped: "MappedBag") -> Any:
        made = [self._marker(each, mapped.stamps[-1]) for each in mapped.markers]
        return self._make("visualization_msgs/msg/MarkerArray", made)

    def _marker(self, fields: Dict[str, Any], stamp: int) -> Any:
        kind: Any = self._types.types["visualization_msgs/msg/Marker"]
        values: Dict[str, Any] = {
            "header": self._header(stamp),
            "ns": fields["ns"],
            "id": fields["id"],
            "type": 5 if fields["lines"] else 1,  # LINE_LIST, CUBE
            "action": 0,
            "pose": self._pose(fields["position"], fields["orientation"]),
            "scale": self._make("geometry_msgs/msg/Vector3", *fields["scale"]),
            "color": self._make("std_msgs/msg/ColorRGBA", *fields["colour"]),
            "lifetime": self._make("builtin_interfaces/msg/Duration", 0, 0),
            "frame_locked": False,
            "points": [self._make("geometry_msgs/msg/Point", *p) for p in fields["points"]],
            "colors": [],
            "texture_resource": "",
            "texture": (
                self._make(
                    "sensor_msgs/msg/CompressedImage",
                    self._header(stamp),
                    "",
                    np.zeros(0, np.uint8),
                )
                if "sensor_msgs/msg/CompressedImage" in self._types.types
                else None
            ),
            "uv_coordinates": [],
            "text": "",
            "mesh_resource": "",
            "mesh_file": (
                self._make("visualization_msgs/msg/MeshFile", "", np.zeros(0, np.uint8))
                if "visualization_msgs/msg/MeshFile" in self._types.types
                else None
            ),
            "mesh_use_embedded_materials": False,
        }
        names = [name for name in kind.__dataclass_fields__ if name in values]
        return kind(**{name: values[name] for name in names})
