#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""replay_keyframes.py: a sequence folder of sslcd as VINS-Fusion's estimator would publish it, for replay.sh.

  config FOLDER IMU OUT          writes VINS's configuration (OUT/vins.yaml, OUT/cam0.yaml)
  publish FOLDER IMU HZ          publishes keyframes, points, images and extrinsics
  tum FOLDER IMU VIO_LOOP OUT    VINS's poses and the odometry of the same keyframes, of cameras, as a run of sslcd_run
"""
import sys
from pathlib import Path

# Quaternions w x y z and vectors, without NumPy. A pose is (q, t).
IDENTITY = ((1, 0, 0, 0), (0, 0, 0))
# With an IMU the body has x forward and z up, and stands where the camera is but for a lever arm.
BODY_CAM = ((0.5, -0.5, 0.5, -0.5), (0.3, 0.05, 0.1))
UP_WORLD = ((0.5, -0.5, 0.5, -0.5), (0, 0, 0))  # z up, from the first camera's axes
SKIPPED_TIME = 5  # seconds for the subscribers to connect


def times(p, q):
    a, b, c, d = p
    e, f, g, h = q
    return (a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g,
            a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e)


def turn(q, v):
    w, x, y, z = q
    return times(times(q, (0, *v)), (w, -x, -y, -z))[1:]


def compose(a, b):
    moved = turn(a[0], b[1])
    return times(a[0], b[0]), tuple(m + t for m, t in zip(moved, a[1]))


def inverse(pose):
    (w, x, y, z), t = pose
    q = (w, -x, -y, -z)
    return q, tuple(-v for v in turn(q, t))


def read_odometry(folder):
    rows = [[float(word) for word in line.split()] for line in (Path(folder) / "odometry.txt").read_text().splitlines()
            if line and line[0] != "#"]
    return [(row[0], ((row[7], row[4], row[5], row[6]), tuple(row[1:4]))) for row in rows]


def rig(imu):
    """T_body_cam, and VINS's world from the odometry's."""
    return (BODY_CAM, UP_WORLD) if imu else (IDENTITY, IDENTITY)


def write_config(folder, imu, out):
    calib = {row.split(":")[0]: row.split()[1:] for row in (Path(folder) / "calib.txt").read_text().splitlines()}
    p = [float(word) for word in calib["P2"]]
    body_cam = rig(imu)[0]
    columns = [turn(body_cam[0], axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))] + [body_cam[1]]
    matrix = ", ".join(f"{column[row]:.12g}" for row in range(3) for column in columns)
    out = Path(out)
    (out / "cam0.yaml").write_text(
        "%YAML:1.0\n---\nmodel_type: PINHOLE\ncamera_name: camera\nimage_width: 1280\nimage_height: 720\n"
        "distortion_parameters:\n   k1: 0\n   k2: 0\n   p1: 0\n   p2: 0\nprojection_parameters:\n"
        f"   fx: {p[0]}\n   fy: {p[5]}\n   cx: {p[2]}\n   cy: {p[6]}\n")
    (out / "vins.yaml").write_text(
        f"%YAML:1.0\nimu: {imu}\nnum_of_cam: 2\nimage0_topic: \"/replay/image\"\noutput_path: \"{out}\"\n"
        "cam0_calib: \"cam0.yaml\"\nimage_width: 1280\nimage_height: 720\nsave_image: 0\n"
        f"pose_graph_save_path: \"{out}/\"\nload_previous_pose_graph: 0\nsslcd_detections: \"{Path(folder).resolve()}\"\n"
        f"body_T_cam0: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [{matrix}, 0, 0, 0, 1]\n")


def publish(folder, imu, hz):
    import rospy
    from nav_msgs.msg import Odometry
    from sensor_msgs.msg import Image, PointCloud
    rospy.init_node("replay_keyframes")
    body_cam, vins_world = rig(imu)

    def advertise(topic, kind):
        return rospy.Publisher(topic, kind, queue_size=100)
    poses = advertise("/vins_estimator/keyframe_pose", Odometry)
    extrinsics = advertise("/vins_estimator/extrinsic", Odometry)
    points = advertise("/vins_estimator/keyframe_point", PointCloud)
    images = advertise("/replay/image", Image)

    def message(kind, stamp):
        out = kind()
        out.header.stamp = rospy.Time.from_sec(stamp)
        out.header.frame_id = "world"
        return out

    def odometry(stamp, pose):
        out = message(Odometry, stamp)
        q, p = out.pose.pose.orientation, out.pose.pose.position
        (q.w, q.x, q.y, q.z), (p.x, p.y, p.z) = pose
        return out
    while images.get_num_connections() == 0 and not rospy.is_shutdown():
        rospy.sleep(0.1)
    rospy.sleep(SKIPPED_TIME)
    rate = rospy.Rate(hz)
    for stamp, T_odom_cam in read_odometry(folder):
        extrinsics.publish(odometry(stamp, body_cam))
        image = message(Image, stamp)
        image.height, image.width, image.step, image.encoding = 72, 128, 128, "mono8"
        image.data = bytes(72 * 128)
        images.publish(image)
        points.publish(message(PointCloud, stamp))
        poses.publish(odometry(stamp, compose(compose(vins_world, T_odom_cam), inverse(body_cam))))
        rate.sleep()
        if rospy.is_shutdown():
            sys.exit("stopped")


def tum_row(stamp, pose):
    (w, x, y, z), t = pose
    return " ".join(f"{v:.9f}" for v in (stamp, *t, x, y, z, w)) + "\n"


def write_tum(folder, imu, vio_loop, out):
    body_cam, vins_world = rig(imu)
    odometry = {round(stamp * 1e3): pose for stamp, pose in read_odometry(folder)}
    after, before = "", ""
    for line in Path(vio_loop).read_text().splitlines():
        row = [float(word) for word in line.split(",") if word]
        stamp = row[0] * 1e-9
        body = (tuple(row[4:8]), tuple(row[1:4]))
        after += tum_row(stamp, compose(compose(inverse(vins_world), body), body_cam))
        before += tum_row(stamp, odometry[round(stamp * 1e3)])
    Path(out).mkdir(exist_ok=True)
    (Path(out) / "trajectory_tum.txt").write_text(after)
    (Path(out) / "odometry_tum.txt").write_text(before)


def main(arguments):
    if len(arguments) == 4 and arguments[0] == "config":
        write_config(arguments[1], int(arguments[2]), arguments[3])
    elif len(arguments) == 4 and arguments[0] == "publish":
        publish(arguments[1], int(arguments[2]), float(arguments[3]))
    elif len(arguments) == 5 and arguments[0] == "tum":
        write_tum(arguments[1], int(arguments[2]), arguments[3], arguments[4])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
