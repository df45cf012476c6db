# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_node with a real roscore: a drive as messages, bad ones among them, time that is set back, a
roscore that dies. Ends with 77 where ROS 1 is not installed.

    smoke_test.py SSLCD_NODE SEQUENCE
"""
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

if sys.argv[1] == 'none' or not shutil.which('roscore'):
    print('skipped: no ROS 1; scripts/install_deps.sh test installs it')
    sys.exit(77)
try:
    import numpy as np
    import rosgraph
    import rospy
    from geometry_msgs.msg import TransformStamped
    from nav_msgs.msg import Odometry, Path
    from std_srvs.srv import Empty
    from tf2_msgs.msg import TFMessage
    from visualization_msgs.msg import Marker, MarkerArray
    import robot
except ImportError as missing:
    print(f'skipped: {missing}')
    sys.exit(77)

START = 1.7e9  # of the stamps [s]


def free_port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def wait_until(what, condition, seconds):
    end = time.time() + seconds
    while not condition():
        if time.time() > end:
            raise AssertionError(f'not after {seconds} s: {what}')
        time.sleep(0.02)


class Drive:
    """Publishes a sequence as a robot, and keeps what comes back."""

    def __init__(self, folder):
        self.types = robot.vision_msgs()
        self.stamps, self.odometry = robot.read_bases(os.path.join(folder, 'odometry.txt'))
        self.truth = robot.read_bases(os.path.join(folder, 'groundtruth.txt'))[1]
        self.objects = robot.read_detections(folder)
        self.path, self.path_stamps, self.markers, self.correction = [], [], [], None
        rospy.Subscriber('/sslcd/path', Path, self.on_path)
        rospy.Subscriber('/sslcd/map', MarkerArray, self.on_map)
        rospy.Subscriber('/tf', TFMessage, self.on_tf)
        self.odom = rospy.Publisher('odom', Odometry, queue_size=1000)
        self.detections = rospy.Publisher('detections', self.types['Detection3DArray'],
                                          queue_size=1000)
        self.tf_static = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        extrinsics = TransformStamped(child_frame_id='camera')
        extrinsics.header.frame_id = 'base_link'
        self.fill(extrinsics.transform.translation, robot.T_BASE_CAM[:3, 3])
        self.fill(extrinsics.transform.rotation, robot.quaternion(robot.R_BODY_CAM))
        self.tf_static.publish(TFMessage([extrinsics]))

    @staticmethod
    def fill(message, values):
        for name, value in zip(message.__slots__, values):
            setattr(message, name, float(value))

    def fill_pose(self, message, T):
        self.fill(message.position, T[:3, 3])
        self.fill(message.orientation, robot.quaternion(T[:3, :3]))

    def matrix(self, position, q):
        return robot.transform([position.x, position.y, position.z],
                               robot.rotation([q.x, q.y, q.z, q.w]))

    def on_path(self, message):
        self.path_stamps = [p.header.stamp.to_sec() - START for p in message.poses]
        self.path = [self.matrix(p.pose.position, p.pose.orientation) for p in message.poses]

    def on_map(self, message):
        self.markers = message.markers

    def on_tf(self, message):
        for found in message.transforms:
            if (found.header.frame_id, found.child_frame_id) == ('map', 'odom'):
                self.correction = self.matrix(found.transform.translation, found.transform.rotation)

    def odometry_of(self, i):
        message = Odometry(child_frame_id='base_link')
        message.header.frame_id = 'odom'
        message.header.stamp = rospy.Time.from_sec(START + self.stamps[i])
        self.fill_pose(message.pose.pose, self.odometry[i])
        return message

    def detections_of(self, i):
        message = self.types['Detection3DArray']()
        message.header.frame_id = 'camera'
        message.header.stamp = rospy.Time.from_sec(START + self.stamps[i])
        for label, T_cam_object, size, score in self.objects.get(i, []):
            box = self.types['Detection3D']()
            result = self.types['ObjectHypothesisWithPose']()
            result.id, result.score = robot.LABELS.index(label), score
            box.results.append(result)
            self.fill_pose(box.bbox.center, T_cam_object)
            self.fill(box.bbox.size, size)
            message.detections.append(box)
        return message

    def play(self, frames, hz):
        for i in frames:
            self.odom.publish(self.odometry_of(i))
            self.detections.publish(self.detections_of(i))
            time.sleep(1 / hz)

    def play_bad_messages(self, i):
        """Ten messages that cannot be used."""
        for change in ('duplicate', 'frame', 'nan', 'quaternion'):
            bad = self.odometry_of(i)
            if change == 'frame':
                bad.child_frame_id = 'gps'
            elif change == 'nan':
                bad.pose.pose.position.x = float('nan')
            elif change == 'quaternion':
                self.fill(bad.pose.pose.orientation, [0, 0, 0, 0])
            self.odom.publish(bad)
        self.detections.publish(self.detections_of(i))  # a second time
        early = self.detections_of(i)
        early.header.stamp = rospy.Time.from_sec(1)
        self.detections.publish(early)
        unknown = self.detections_of(i + 1)
        unknown.header.frame_id = 'radar'
        self.detections.publish(unknown)
        self.odom.publish(self.odometry_of(i + 1))
        objects = self.detections_of(i + 2)
        objects.detections = objects.detections[:3]
        objects.detections[0].results[0].id = 99
        objects.detections[1].results = []
        self.fill(objects.detections[2].bbox.center.orientation, [0, 0, 0, 0])
        self.detections.publish(objects)
        self.odom.publish(self.odometry_of(i + 2))


def check_drive(drive):
    frames = len(drive.stamps)
    drive.play(range(100), hz=100)
    drive.play_bad_messages(99)
    drive.play(range(102, frames), hz=100)
    made = frames - 1  # that of 'radar' is not used
    wait_until(f'{made} poses', lambda: len(drive.path) == made, 15)
    index = [i for i in range(frames) if i != 100]
    before = robot.ate([drive.odometry[i] for i in index], [drive.truth[i] for i in index])
    after = robot.ate(drive.path, [drive.truth[i] for i in index])
    print(f'ATE {after:.2f} m, of the odometry {before:.2f} m')
    assert np.allclose(drive.path_stamps, [drive.stamps[i] for i in index], rtol=0, atol=1e-5)
    assert after < 0.6 * before
    wait_until('the correction that belongs to the path', lambda: np.abs(
        drive.correction @ drive.odometry[-1] - drive.path[-1]).max() < 1e-6, 3)
    wait_until('loops on the map', lambda: any(
        m.type == Marker.LINE_LIST and len(m.points) >= 10 for m in drive.markers), 5)
    assert drive.markers[0].action == Marker.DELETEALL
    cubes = [m for m in drive.markers if m.type == Marker.CUBE and m.action == Marker.ADD]
    print(f'{len(cubes)} objects')
    assert 30 < len(cubes) < 200 and {m.ns for m in cubes} <= set(robot.LABELS)
    drive.path = []
    rospy.ServiceProxy('/sslcd/refine', Empty)()
    wait_until('a refined path', lambda: len(drive.path) == made, 10)
    refined = robot.ate(drive.path, [drive.truth[i] for i in index])
    print(f'refined: ATE {refined:.2f} m')
    assert refined < after
    return made


def check_wrong_parameters(program):
    run = subprocess.run([program, '__name:=wrong', '_labelz:=Car', '_max_gap_s:=-1',
                          '_map_every_s:=often', '_tf_ahead_s:=1e9', '_symmetries:=none,round'],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=20,
                         check=False)
    assert run.returncode == 2, run.stdout
    for problem in ('unknown parameter ~labelz', '~labels is missing', '~max_gap_s is -1',
                    '~map_every_s has another type', '~tf_ahead_s must',
                    '~symmetries is longer than ~labels'):
        assert problem in run.stdout, run.stdout


def test(program, folder, work, started):
    log = open(os.path.join(work, 'node.txt'), 'w+', encoding='utf-8')
    roscore = subprocess.Popen(['roscore', '-p', os.environ['ROS_MASTER_URI'].rsplit(':')[-1]],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    started.append(roscore)
    wait_until('the roscore is there', rosgraph.is_master_online, 30)
    check_wrong_parameters(program)
    rospy.init_node('robot', disable_signals=True)
    rospy.set_param('/sslcd', {'labels': robot.LABELS, 'map_every_s': 1., 'most_frames': 1000})
    node = subprocess.Popen([program, '_symmetries:=' + ','.join(robot.SYMMETRIES)], stdout=log,
                            stderr=log)
    started.append(node)
    drive = Drive(folder)
    wait_until('connections', lambda: all(
        p.get_num_connections() > 0 for p in (drive.odom, drive.detections, drive.tf_static)), 20)
    time.sleep(0.5)  # the transform is on its way
    made = check_drive(drive)

    drive.odom.publish(drive.odometry_of(0))  # time is set back
    time.sleep(0.5)  # detections of the new time that come before its odometry are out of order
    drive.play(range(1, 21), hz=50)
    wait_until('a second sequence', lambda: len(drive.path) == made + 20, 10)
    late = drive.odometry_of(20)
    late.header.stamp = rospy.Time(2**32 - 1, 999999999)  # map to odom would be stamped later still
    drive.odom.publish(late)
    time.sleep(0.5)
    rospy.ServiceProxy('/sslcd/start_sequence', Empty)()
    roscore.terminate()
    roscore.wait(20)
    assert node.poll() is None, 'the node ends with its roscore'
    drive.play(range(21, 31), hz=50)
    wait_until('poses without a roscore', lambda: len(drive.path) == made + 30, 10)

    node.send_signal(signal.SIGINT)
    assert node.wait(15) == 0
    log.seek(0)
    text = log.read()
    print(text.strip().split('\n')[-1])
    for count in ('2 odometry: pose not', '1 odometry: another frame', '1 odometry: duplicate',
                  '1 detections: no transform', '2 detections: out of order', '3 objects'):
        assert count in text.strip().split('\n')[-1], f'{count}: {text}'
    assert ' closed: ' in text and 'searches' in text, text


def main():
    os.environ['ROS_MASTER_URI'] = f'http://127.0.0.1:{free_port()}'
    os.environ['ROS_IP'] = '127.0.0.1'
    started = []
    with tempfile.TemporaryDirectory() as work:
        os.environ['ROS_LOG_DIR'] = os.environ['ROS_HOME'] = work
        try:
            test(sys.argv[1], sys.argv[2], work, started)
        finally:
            for process in started:
                if process.poll() is None:
                    process.terminate()
                    try:
                        process.wait(10)
                    except subprocess.TimeoutExpired:
                        process.kill()
            if sys.exc_info()[0] and os.path.exists(os.path.join(work, 'node.txt')):
                with open(os.path.join(work, 'node.txt'), encoding='utf-8') as log:
                    print(log.read())
    os._exit(0)  # rospy's threads wait for a master that is gone


if __name__ == '__main__':
    main()
