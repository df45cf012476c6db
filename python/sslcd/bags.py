# SPDX-License-Identifier: BSD-3-Clause
"""ROS 1 bags, ROS 2 bags and MCAP, without ROS: `pip install 'sslcd[bags]'`.

Messages go through the same bridge as in sslcd's nodes (integrations/ros_bridge): it pairs
detections with the odometry at their stamp and takes extrinsics from /tf_static.
"""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .compact import _Compact
from .errors import BadInputError
from .mapper import Mapper, _wrap, context
from .options import Options, settings
from .results import Trajectory

try:
    from rosbags.highlevel import AnyReader, AnyReaderError
    from rosbags.interfaces import Connection
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    from rosbags.typesys.store import Typestore

    from .bag_writer import write_bag
except ImportError as problem:
    raise ImportError(
        f"sslcd.bags needs rosbags: pip install 'sslcd[bags]' ({problem})"
    ) from problem

__all__ = ["BagLoop", "MappedBag", "map_bag", "typestore", "write_bag"]

AnyPath = Union[str, "os.PathLike[str]"]
ODOMETRY = "nav_msgs/msg/Odometry"
DETECTIONS = "vision_msgs/msg/Detection3DArray"
TRANSFORMS = "tf2_msgs/msg/TFMessage"
_LONGEST_STEP_BACK_S = 0.5  # BridgeOptions::max_gap_s: more is a jump, less is a late message

# vision_msgs of ROS 2, for bags that do not bring the definitions of their messages
_VISION_MSGS = {
    "vision_msgs/msg/ObjectHypothesis": "string class_id\nfloat64 score\n",
    "vision_msgs/msg/ObjectHypothesisWithPose": (
        "vision_msgs/ObjectHypothesis hypothesis\ngeometry_msgs/PoseWithCovariance pose\n"
    ),
    "vision_msgs/msg/BoundingBox3D": "geometry_msgs/Pose center\ngeometry_msgs/Vector3 size\n",
    "vision_msgs/msg/Detection3D": (
        "std_msgs/Header header\nvision_msgs/ObjectHypothesisWithPose[] results\n"
        "vision_msgs/BoundingBox3D bbox\nstring id\n"
    ),
    DETECTIONS: "std_msgs/Header header\nvision_msgs/Detection3D[] detections\n",
}


@dataclass(frozen=True, eq=False, repr=False)
class BagLoop(_Compact):
    """An accepted loop between two poses of the base."""

    id: int
    match_frame: int  #: Trajectory.frames of the path
    query_frame: int
    match_stamp: int  #: of their messages [ns]
    query_stamp: int
    T_match_query: np.ndarray  #: [4, 4] of the base [m]
    #: [6, 6] of the right perturbation T_match_query Exp(d), d = [translation, rotation] [m, rad]
    covariance: np.ndarray


@dataclass(frozen=True, eq=False, repr=False)
class MappedBag(_Compact):
    """The result of map_bag()."""

    path: Trajectory  #: corrected T_map_base at the stamps of the detections
    stamps: np.ndarray  #: [N] the same stamps [ns]
    loops: List[BagLoop]
    mapper: Mapper  #: its trajectory is that of the camera
    drops: str  #: what could not be used, counted by reason; empty: nothing
    odom_frame: str  #: frame ids that were used
    base_frame: str
    camera_frame: str
    markers: List[Dict[str, Any]]  #: fields of visualization_msgs/Marker: objects and loops


def typestore(store: Stores = Stores.LATEST) -> Typestore:
    """The message definitions of a ROS distribution, with vision_msgs."""
    types = get_typestore(store)
    added: Dict[str, Any] = {}
    for name, text in _VISION_MSGS.items():
        added.update(get_types_from_msg(text, name))
    types.register({name: fields for name, fields in added.items() if name in _VISION_MSGS})
    return types


def map_bag(
    paths: Union[AnyPath, Sequence[AnyPath]],
    odometry: str,
    detections: str,
    options: Optional[Options] = None,
    *,
    labels: Optional[Mapping[str, str]] = None,
    up: ArrayLike = (0.0, 0.0, 1.0),
    class_names: Optional[Mapping[str, str]] = None,
    body_axes: bool = False,
    odom_frame: str = "",
    base_frame: str = "",
    camera_frame: str = "",
    new_sequences: bool = False,
) -> MappedBag:
    """Maps a recorded drive.

    Args:
        paths: a ROS 1 .bag, a ROS 2 bag folder or .mcap; several are one recording.
        odometry: topic of nav_msgs/Odometry.
        detections: topic of vision_msgs/Detection3DArray: cuboids in the frame of the message,
            origin in the centre, x along the length, y to the left, z up; size is length, width,
            height [m]; the score is a probability.
        options, labels: as of Mapper.
        up: [3] in the odometry's frame.
        class_names: labels by class id.
        body_axes: camera_frame has x forward, y left, z up, as of a LiDAR.
        odom_frame, base_frame, camera_frame: frame ids; default: those of the first messages.
            Extrinsics come from /tf_static.
        new_sequences: where stamps go back, a new sequence begins.

    Raises:
        BadInputError: with a way out, for a bag without the topics, with messages of other types,
            with stamps that go back, or from which no frame could be made.
    """
    frames = {"odom_frame": odom_frame, "base_frame": base_frame, "camera_frame": camera_frame}
    bridge = _core.RosBridge(frames, body_axes, settings(options), context(labels, up))
    feed = _Feed(bridge, odometry, detections, dict(class_names or {}), new_sequences)
    for topic, message in _messages(paths, {odometry: ODOMETRY, detections: DETECTIONS}):
        feed.add(topic, message)
    made = bridge.finish()
    if len(made["stamps"]) == 0:
        why = made["drops"] or f"{detections} or {odometry} has no messages"
        raise BadInputError(
            f"{paths}: no frame could be made: {why}. Detections need odometry at their stamp, and "
            "a transform of /tf_static from their frame to the base: record these, or give "
            "detections in the odometry's child frame"
        )
    core = made.pop("mapper")
    path = Trajectory(made.pop("frames"), made["stamps"] * 1e-9, made.pop("poses"))
    loops = [BagLoop(**loop) for loop in made.pop("loops")]
    return MappedBag(path=path, loops=loops, mapper=_wrap(core, int(path.frames[-1]) + 1), **made)


class _Feed:
    """Hands messages to the bridge."""

    def __init__(
        self, bridge: Any, odometry: str, detections: str, names: Dict[str, str], jumps: bool
    ) -> None:
        self._bridge, self._odometry, self._detections = bridge, odometry, detections
        self._names, self._may_jump = names, jumps
        self._newest: Dict[str, int] = {}

    def add(self, topic: str, message: Any) -> None:
        if topic == self._odometry:
            self._add_odometry(message)
        elif topic == self._detections:
            self._add_detections(message)
        else:
            for each in message.transforms:
                t, q = each.transform.translation, each.transform.rotation
                pose = ((t.x, t.y, t.z), (q.x, q.y, q.z, q.w))
                self._bridge.add_transform(each.header.frame_id, each.child_frame_id, pose)

    def _add_odometry(self, message: Any) -> None:
        stamp = self._stamp(self._odometry, message)
        frames = {"frame": message.header.frame_id, "child_frame": message.child_frame_id}
        covariance = np.asarray(message.pose.covariance, np.float64).tolist()
        self._bridge.add_odometry(stamp, frames, _pose(message.pose.pose), covariance)

    def _add_detections(self, message: Any) -> None:
        stamp = self._stamp(self._detections, message)
        found = []
        for each in message.detections:
            hypotheses = [getattr(result, "hypothesis", result) for result in each.results]
            size = each.bbox.size
            found.append(
                (
                    [(self._label(one), float(one.score)) for one in hypotheses],
                    _pose(each.bbox.center),
                    (size.x, size.y, size.z),
                )
            )
        self._bridge.add_detections(stamp, message.header.frame_id, found)

    def _label(self, hypothesis: Any) -> str:
        name = str(hypothesis.class_id if hasattr(hypothesis, "class_id") else hypothesis.id)
        return self._names.get(name, name)

    def _stamp(self, topic: str, message: Any) -> int:
        time = message.header.stamp
        stamp = int(time.sec) * 10**9 + int(time.nanosec)
        back_s = (self._newest.get(topic, stamp) - stamp) * 1e-9
        if back_s > _LONGEST_STEP_BACK_S and not self._may_jump:
            raise BadInputError(
                f"{topic}: the stamp {stamp * 1e-9:.3f} s is {back_s:.3f} s before the one that "
                "came before it. If the bag holds several drives, new_sequences=True joins them; "
                "otherwise its clock was set: cut it there"
            )
        self._newest[topic] = stamp
        return stamp


def _pose(pose: Any) -> Tuple[Tuple[float, ...], Tuple[float, ...]]:
    p, q = pose.position, pose.orientation
    return (p.x, p.y, p.z), (q.x, q.y, q.z, q.w)


def _messages(
    paths: Union[AnyPath, Sequence[AnyPath]], types: Dict[str, str]
) -> Iterator[Tuple[str, Any]]:
    """The messages of these topics and of /tf_static, in the order of recording. All static
    transforms come first: they hold for the whole bag."""
    files = [Path(paths)] if isinstance(paths, (str, os.PathLike)) else [Path(p) for p in paths]
    try:
        with AnyReader(files, default_typestore=typestore()) as reader:
            static = [each for each in reader.connections if each.topic == "/tf_static"]
            _check_topics(", ".join(map(str, files)), reader.connections, types)
            wanted = [each for each in reader.connections if each.topic in types]
            for connections in (static, wanted):
                if connections:
                    for connection, _, raw in reader.messages(connections):
                        message = reader.deserialize(raw, connection.msgtype)
                        yield connection.topic, message
    except (AnyReaderError, OSError, KeyError) as problem:
        raise BadInputError(f"{', '.join(map(str, files))}: {problem}") from problem


def _check_topics(name: str, connections: List[Connection], types: Dict[str, str]) -> None:
    there = {each.topic: each.msgtype for each in connections}
    for topic, wanted in types.items():
        if topic not in there:
            like = [each for each, kind in sorted(there.items()) if kind == wanted]
            raise BadInputError(
                f"{name}: no topic {topic}; "
                + (f"topics of {wanted}: {', '.join(like)}" if like else f"none has {wanted}")
                + f"; all topics: {', '.join(sorted(there)) or 'none'}"
            )
        if there[topic] != wanted:
            raise BadInputError(
                f"{name}: {topic} has messages {there[topic]}, expected {wanted}: choose another "
                "topic, or convert the messages (docs/python.md)"
            )
