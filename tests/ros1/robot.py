# SPDX-License-Identifier: BSD-3-Clause
"""A sequence folder as the messages of a robot: base_link has the axes of a body (x forward, y left,
z up), and so has its odometry's world."""
import os

import genpy.dynamic
import numpy as np

# Axes of a camera (x right, y down, z forward) in those of a body.
R_BODY_CAM = np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])
T_BASE_CAM = np.eye(4)
T_BASE_CAM[:3, :3] = R_BODY_CAM
T_BASE_CAM[:3, 3] = [0.4, 0.1, 1.2]
LABELS = ['Car', 'Pole', 'Tree', 'Truck', 'Van']
SYMMETRIES = ['none', 'full', 'full', 'none', 'none']

# vision_msgs 0.0.1, without its comments
DETECTION_3D_ARRAY = '''Header header
vision_msgs/Detection3D[] detections
===
MSG: vision_msgs/Detection3D
Header header
ObjectHypothesisWithPose[] results
BoundingBox3D bbox
sensor_msgs/PointCloud2 source_cloud
===
MSG: vision_msgs/ObjectHypothesisWithPose
int64 id
float64 score
geometry_msgs/PoseWithCovariance pose
===
MSG: vision_msgs/BoundingBox3D
geometry_msgs/Pose center
geometry_msgs/Vector3 size
===
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
===
MSG: geometry_msgs/PoseWithCovariance
Pose pose
float64[36] covariance
===
MSG: geometry_msgs/Pose
Point position
Quaternion orientation
===
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
===
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
===
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
===
MSG: sensor_msgs/PointCloud2
Header header
uint32 height
uint32 width
PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
===
MSG: sensor_msgs/PointField
uint8 INT8=1
uint8 UINT8=2
uint8 INT16=3
uint8 UINT16=4
uint8 INT32=5
uint8 UINT32=6
uint8 FLOAT32=7
uint8 FLOAT64=8
string name
uint32 offset
uint8 datatype
uint32 count
'''


def vision_msgs():
    """The message classes, by genpy, as rosbag makes them of a bag's definitions."""
    made = genpy.dynamic.generate_dynamic('vision_msgs/Detection3DArray',
                                          DETECTION_3D_ARRAY.replace('===', '=' * 80))
    return {name.split('/')[1]: made[name] for name in made if name.startswith('vision_msgs/')}


def rotation(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def quaternion(R):
    """x y z w of a rotation, by the eigenvector of Bar-Itzhack's matrix."""
    K = np.array([[R[0, 0] - R[1, 1] - R[2, 2], 0, 0, 0],
                  [R[1, 0] + R[0, 1], R[1, 1] - R[0, 0] - R[2, 2], 0, 0],
                  [R[2, 0] + R[0, 2], R[2, 1] + R[1, 2], R[2, 2] - R[0, 0] - R[1, 1], 0],
                  [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], np.trace(R)]]) / 3
    return np.linalg.eigh(K)[1][:, -1]


def transform(t, R):
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = t
    return T


def read_bases(path):
    """Stamps, and T_odom_base of TUM rows with poses of the camera."""
    rows = np.loadtxt(path)
    T_world = transform(np.zeros(3), R_BODY_CAM)
    bases = [T_world @ transform(row[1:4], rotation(row[4:])) @ np.linalg.inv(T_BASE_CAM)
             for row in rows]
    return rows[:, 0], bases


def read_detections(folder):
    """{frame: [(label, T_cam_object, [length, width, height], score)]} of KITTI tracking rows."""
    found = {}
    with open(os.path.join(folder, 'detections.txt'), encoding='utf-8') as file:
        for line in file:
            words = line.split()
            h, w, l, x, y, z, ry, score = [float(word) for word in words[10:18]]
            along, up = np.array([np.cos(ry), 0, -np.sin(ry)]), np.array([0, -1, 0])
            R = np.column_stack([along, np.cross(up, along), up])
            found.setdefault(int(words[0]), []).append(
                (words[2], transform([x, y - h / 2, z], R), [l, w, h], score))
    return found


def ate(estimate, truth):
    """RMSE of positions [m] after the best rotation and translation (Horn)."""
    a = np.array([T[:3, 3] for T in estimate])
    b = np.array([T[:3, 3] for T in truth])
    a, b = a - a.mean(0), b - b.mean(0)
    U, _, Vt = np.linalg.svd(a.T @ b)
    R = Vt.T @ np.diag([1, 1, np.linalg.det(Vt.T @ U.T)]) @ U.T
    return np.sqrt(np.mean(np.sum((a @ R.T - b) ** 2, axis=1)))
