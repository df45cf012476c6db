# SPDX-License-Identifier: BSD-3-Clause
"""Bags of a simulated drive, as a robot would record them."""

from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg

from sslcd import _core
from sslcd.bags import DETECTIONS, ODOMETRY, TRANSFORMS, typestore

ROS1_HYPOTHESIS = "int64 id\nfloat64 score\ngeometry_msgs/PoseWithCovariance pose\n"
TF_MESSAGE = "geometry_msgs/TransformStamped[] transforms\n"


class Recorder:
    """Writes messages as ROS 1 (.bag) or ROS 2 (.mcap folder or SQLite folder)."""

    def __init__(self, path, plugin=StoragePlugin.MCAP):
        self.ros1 = Path(path).suffix == ".bag"
        self.types = typestore(Stores.ROS1_NOETIC if self.ros1 else Stores.LATEST)
        if self.ros1:  # vision_msgs of ROS 1 have numbers for classes
            name = "vision_msgs/msg/ObjectHypothesisWithPose"
            for kind in (name, "vision_msgs/msg/ObjectHypothesis"):
                self.types.fielddefs.pop(kind)
            self.types.register(get_types_from_msg(ROS1_HYPOTHESIS, name))
            self.types.register(get_types_from_msg(TF_MESSAGE, TRANSFORMS))
        self.writer = (
            Writer1(path) if self.ros1 else Writer2(path, version=9, storage_plugin=plugin)
        )
        self.connections = {}
        self.received = 10**9

    def __enter__(self):
        self.writer.open()
        return self

    def __exit__(self, *exception):
        self.writer.close()

    def make(self, kind, *values):
        return self.types.types[kind](*values)

    def header(self, stamp, frame):
        time = self.make("builtin_interfaces/msg/Time", *divmod(round(stamp * 1e9), 10**9))
        return self.make("std_msgs/msg/Header", *([0] if self.ros1 else []), time, frame)

    def pose(self, T):
        numbers = [float(v) for v in _core.tum_text(np.zeros(1), T[None]).split()[1:]]
        return self.make(
            "geometry_msgs/msg/Pose",
            self.make("geometry_msgs/msg/Point", *numbers[:3]),
            self.make("geometry_msgs/msg/Quaternion", *numbers[3:]),
        )

    def write(self, topic, kind, message):
        if topic not in self.connections:
            self.connections[topic] = self.writer.add_connection(topic, kind, typestore=self.types)
        serialize = self.types.serialize_ros1 if self.ros1 else self.types.serialize_cdr
        self.received += 10**7  # a clock of its own, as that of the recording machine [ns]
        self.writer.write(self.connections[topic], self.received, serialize(message, kind))

    def odometry(self, stamp, T_odom_base, topic="/odom", child="base_link"):
        pose = self.make(
            "geometry_msgs/msg/PoseWithCovariance", self.pose(T_odom_base), np.zeros(36)
        )
        zero = self.make("geometry_msgs/msg/Vector3", 0.0, 0.0, 0.0)
        twist = self.make(
            "geometry_msgs/msg/TwistWithCovariance",
            self.make("geometry_msgs/msg/Twist", zero, zero),
            np.zeros(36),
        )
        message = self.make(ODOMETRY, self.header(stamp, "odom"), child, pose, twist)
        self.write(topic, ODOMETRY, message)

    def detections(self, frame, names, topic="/detections", frame_id="camera"):
        header = self.header(frame.stamp, frame_id)
        found = []
        for label, T, dims, score in zip(frame.labels, frame.poses, frame.dims, frame.scores):
            pose = self.make("geometry_msgs/msg/PoseWithCovariance", self.pose(T), np.zeros(36))
            kind = "vision_msgs/msg/ObjectHypothesisWithPose"
            if self.ros1:
                result = self.make(kind, names.index(label), float(score), pose)
            else:
                one = self.make("vision_msgs/msg/ObjectHypothesis", label, float(score))
                result = self.make(kind, one, pose)
            size = self.make("geometry_msgs/msg/Vector3", *map(float, dims))
            box = self.make("vision_msgs/msg/BoundingBox3D", self.pose(T), size)
            found.append(self.make("vision_msgs/msg/Detection3D", header, [result], box, ""))
        self.write(topic, DETECTIONS, self.make(DETECTIONS, header, found))

    def extrinsics(self, T_base_cam):
        pose = self.pose(T_base_cam)
        transform = self.make(
            "geometry_msgs/msg/Transform",
            self.make(
                "geometry_msgs/msg/Vector3", pose.position.x, pose.position.y, pose.position.z
            ),
            pose.orientation,
        )
        stamped = self.make(
            "geometry_msgs/msg/TransformStamped", self.header(0, "base_link"), "camera", transform
        )
        self.write("/tf_static", TRANSFORMS, self.make(TRANSFORMS, [stamped]))


def record(path, drive, plugin=StoragePlugin.MCAP, T_base_cam=np.eye(4), with_tf=True):
    """The drive as a bag. Returns the classes by the number that ROS 1 gives them."""
    names = sorted(drive.labels)
    with Recorder(path, plugin) as bag:
        if with_tf:
            bag.extrinsics(T_base_cam)
        for frame in drive:
            bag.odometry(frame.stamp, frame.T_odom_cam @ np.linalg.inv(T_base_cam))
            bag.detections(frame, names)
    return {str(number): name for number, name in enumerate(names)}
