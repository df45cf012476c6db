# SPDX-License-Identifier: BSD-3-Clause
"""replay_keyframes.py turns a sequence into VINS's poses and back, without ROS."""
import importlib.util
import math
import os
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "integrations/vins_fusion/replay_keyframes.py"
spec = importlib.util.spec_from_file_location("replay_keyframes", SCRIPT)
replay = importlib.util.module_from_spec(spec)
spec.loader.exec_module(replay)

# 2 m ahead (camera: z forward), then a turn to the right (about y, which is down)
ODOMETRY = f"0 0 0 0 0 0 0 1\n0.5 0 0 2 0 0 0 1\n1.0 0 -0.5 4 0 {math.sin(0.3)} 0 {math.cos(0.3)}\n"


class ReplayKeyframes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.drive = Path(self.folder.name)
        (self.drive / "odometry.txt").write_text(ODOMETRY)
        (self.drive / "calib.txt").write_text("P2: 450 0 640 0 0 510 360 0 0 0 1 0\n")

    def vins_poses(self, imu):
        body_cam, world = replay.rig(imu)
        return [(stamp, replay.compose(replay.compose(world, pose), replay.inverse(body_cam)))
                for stamp, pose in replay.read_odometry(self.drive)]

    def assert_near(self, a, b):
        for x, y in zip(a, b):
            self.assertAlmostEqual(x, y, 6)

    def test_bodies_have_x_ahead_and_z_up_with_an_imu(self):
        (_, first), (_, ahead), (_, turned) = self.vins_poses(1)
        self.assert_near(first[0], (1, 0, 0, 0))
        self.assert_near([b - a for a, b in zip(first[1], ahead[1])], (2, 0, 0))
        self.assert_near(replay.turn(turned[0], (1, 0, 0)), (math.cos(0.6), -math.sin(0.6), 0))

    def test_bodies_are_cameras_without(self):
        self.assertEqual(self.vins_poses(0), replay.read_odometry(self.drive))

    def test_poses_that_vins_has_not_moved_are_the_odometry(self):
        for imu in (0, 1):
            rows = [",".join(str(v) for v in (stamp * 1e9, *t, *q)) + ",\n" for stamp, (q, t) in self.vins_poses(imu)]
            (self.drive / "vio_loop.csv").write_text("".join(rows[1:]))
            replay.write_tum(self.drive, imu, self.drive / "vio_loop.csv", self.drive / "run")
            after, before = ((self.drive / "run" / name).read_text().splitlines()
                             for name in ("trajectory_tum.txt", "odometry_tum.txt"))
            self.assertEqual(len(after), 2)
            for a, b in zip(after, before):
                self.assert_near(map(float, a.split()), map(float, b.split()))

    def test_configuration_names_camera_extrinsics_and_detections(self):
        replay.write_config(self.drive, 1, self.drive)
        text = (self.drive / "vins.yaml").read_text()
        self.assertIn("imu: 1\n", text)
        self.assertIn("data: [0, 0, 1, 0.3, -1, 0, 0, 0.05, 0, -1, 0, 0.1, 0, 0, 0, 1]", text)
        self.assertIn(f'sslcd_detections: "{os.path.realpath(self.drive)}"', text)
        self.assertIn("fx: 450.0\n   fy: 510.0\n   cx: 640.0\n   cy: 360.0", (self.drive / "cam0.yaml").read_text())


if __name__ == "__main__":
    unittest.main()
