# SPDX-License-Identifier: BSD-3-Clause
"""The parts `loops` and `kitti`: one `sslcd_run run` for each set, judged by its ground truth."""
import json
import os
import tempfile

from program import rounded
from store import fingerprint

# Data folder, ground truth and role of a set: "development" if thresholds of the product were
# chosen on it, otherwise "held-out".
LOOPS = [
    ('victoria-park', 'reference.txt', 'development'),
    ('kitti-odometry-poles/00', 'groundtruth.txt', 'development'),
    ('kitti-odometry-poles/02', 'groundtruth.txt', 'development'),
    ('kitti-odometry-poles/05', 'groundtruth.txt', 'development'),
    ('forest-evo-fwd', 'groundtruth.txt', 'held-out'),
    ('forest-venman3-fwd', 'groundtruth.txt', 'held-out'),
]
# 0011 has no true poses, so its map cannot be judged.
KITTI = {'det_pointrcnn_car': ['0001', '0005', '0007', '0009'],
         'det_stereo_grade_car': ['0007', '0009']}
ODOMETRY, TRUTH = 'orbslam3_poses', 'oxts_cam0_poses'


class Run:
    """A set whose figures come from one run."""

    def __init__(self, name, role, arguments, inputs):
        self.name, self.role, self.inputs = name, role, inputs
        self.arguments = arguments
        self.missing = next((path for path in inputs if not os.path.exists(path)), None)

    def fingerprint(self):
        return fingerprint(self.inputs, *self.arguments[2:])

    def measure(self, program):
        with tempfile.TemporaryDirectory() as out:
            text, cost = program.run(['run', *self.arguments, '--out', out, '--force', '--json'])
        figures = {key: rounded(value) for key, value in json.loads(text).items()}
        return {**figures, **cost}


def loop_sets(data):
    return [Run('loops/' + folder, role, [f'{data}/{folder}', '--groundtruth', truth],
                [f'{data}/{folder}']) for folder, truth, role in LOOPS]


def kitti_sets(data):
    root = f'{data}/kitti-tracking'
    sets = []
    for detections, sequences in KITTI.items():
        for sequence in sequences:
            inputs = [f'{root}/calib/{sequence}.txt', f'{root}/label_02/{sequence}.txt',
                      f'{root}/{detections}/{sequence}.txt', f'{root}/{ODOMETRY}/{sequence}.txt',
                      f'{root}/{TRUTH}/{sequence}.txt']
            arguments = [root, '--sequence', sequence, '--detections', detections,
                         '--odometry', ODOMETRY, '--groundtruth', TRUTH]
            sets.append(Run(f'kitti/{detections}/{sequence}', 'development', arguments, inputs))
    return sets
