# SPDX-License-Identifier: BSD-3-Clause
"""What tests of sslcd_run detect, and of run from images, share."""
import os
import tempfile

from cli_case import CliCase, call, read
from stereo_world import BASELINE, STEP, look, write_drive, write_png

FRAMES = 8
SEQUENCE = ['calib.txt', 'colours.npy', 'config.yaml', 'detections.txt', 'odometry.txt', 'sequence.yaml', 'times.txt']


class DetectCase(CliCase):
    """A drive of FRAMES frames in self.data, with boxes; what is made of it goes to self.out."""
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp(prefix='sslcd_cli_')
        cls.good = cls.root + '/good'
        write_drive(cls.good, FRAMES)

    def setUp(self):
        super().setUp()
        self.boxes = self.data + '/boxes.txt'

    def detect(self, *args, **kwargs):
        return call('detect', self.data, '--out', self.out, *args, **kwargs)

    def detected(self, *args):
        result = self.detect(*args)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def detected_with_models(self, *args, **kwargs):
        """The result; skips the test without ONNX Runtime."""
        result = self.detect(*args, **kwargs)
        if 'which was not found' in result.stderr:
            self.skipTest('skipped: no ONNX Runtime: ' + result.stderr)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, result, code, *messages):
        super().refused(result, code, *messages)
        self.assertFalse(os.path.exists(self.out + '/detections.txt'), 'a refused call must leave no detections')

    def count(self, result, what):
        rows = [line.split() for line in result.stdout.splitlines() if line.strip().startswith(what)]
        self.assertEqual(len(rows), 1, result.stdout)
        return int(rows[0][-1])

    def heading_walks(self):
        rows = read(self.out + '/config.yaml').splitlines()
        return [float(row.split()[-1]) for row in rows if row.strip().startswith('rotation_walk:')]

    def make_grey(self, frames=range(FRAMES)):
        for index, folder in enumerate(('image_2', 'image_3')):
            for i in frames:
                rows = [row[1::3] for row in look(BASELINE * index, STEP * i)]
                write_png(f'{self.data}/{folder}/{i:06d}.png', rows, channels=1)

    def turn_the_right_camera(self):
        for i in range(FRAMES):  # a pixel to the right and up of the calibration
            rows = [row[3:] + row[-3:] for row in look(BASELINE, i * STEP)]
            write_png(self.data + f'/image_3/{i:06d}.png', rows[:1] + rows[:-1])
