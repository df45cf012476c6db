# SPDX-License-Identifier: BSD-3-Clause
"""`sslcd_run check`: each of the mistakes of mistakes.py is named, and corrected where that is offered.

usage: mistakes_test.py SSLCD_RUN SSLCD_SIM [unittest arguments]"""
import concurrent.futures
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from cli_case import binaries, call, main, read
from mistakes import KITTI_MISTAKES, MISTAKES, SIMULATED_MISTAKES
from sequence_numbers import Sequence, quaternion

FOUND = 6
DATA = os.environ.get('SSLCD_DATA_DIR', os.path.join(os.path.dirname(__file__), '../../../shared/data'))
KITTI = DATA + '/kitti-tracking'


def mistakes_in(result):
    """The ids in the output of check --json."""
    report = json.loads(result.stdout)
    found = [line['mistake'] for line in report['checks'] if 'mistake' in line]
    assert len(found) == report['mistakes'], result.stdout
    return found


def check(folder, *args):
    """The ids of the mistakes found."""
    result = call('check', folder, '--json', *args)
    assert result.returncode in (0, FOUND), f'{folder}: {result.stderr}'
    found = mistakes_in(result)
    assert (result.returncode == FOUND) == bool(found), result.stdout
    return found


def simulate(folder, *args):
    subprocess.run([binaries['sim'], *args, '--out', folder], check=True, capture_output=True)


def wrong_answers(mistakes, sound, root):
    """Makes each mistake and lets it be found: what is wrong, by name."""
    repairable = {cells[4].strip().strip('`'): cells[7].strip() == 'yes' for cells in
                  (line.split('|') for line in call('check', '--mistakes').stdout.splitlines()[2:])}

    def wrong(name):
        expected, change = mistakes[name]
        sequence, folder = Sequence(sound), f'{root}/{name}'
        change(sequence)
        sequence.write(folder)
        result = call('check', folder, '--json', '--fix', folder + '/fixed')
        if not result.stdout:
            return f'{name}: {result.stderr}'
        found = mistakes_in(result)
        if found != [expected]:
            return f'{name}: found {found}, expected {expected}'
        if result.returncode != (0 if repairable[expected] else 3):
            return f'{name}: --fix: {result.returncode} {result.stderr}'
        if not repairable[expected]:
            return f'{name}: --fix wrote something' if os.path.exists(folder + '/fixed') else None
        left = check(folder + '/fixed')
        return f'{name}: --fix leaves {left}' if left else None

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return [text for text in pool.map(wrong, mistakes) if text]


class Mistakes(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.mkdtemp(prefix='sslcd_mistakes_')

    def tearDown(self):
        shutil.rmtree(self.root)

    def test_each_is_named_and_corrected(self):
        simulate(self.root + '/sound', 'halv', '--case', '4', '--seed', '7')
        self.assertEqual(check(self.root + '/sound'), [])
        self.assertEqual(wrong_answers(SIMULATED_MISTAKES, self.root + '/sound', self.root), [])

    @unittest.skipUnless(os.path.isdir(KITTI), f'no data in {KITTI}')
    def test_each_is_named_on_real_drives(self):
        os.makedirs(self.root + '/sound')
        kitti_sequence('0007', self.root + '/sound')
        self.assertEqual(check(self.root + '/sound'), [])
        self.assertEqual(wrong_answers(KITTI_MISTAKES, self.root + '/sound', self.root), [])

    def test_two_at_once_are_both_named(self):
        simulate(self.root + '/sound', 'halv', '--case', '1', '--seed', '8')
        sequence = Sequence(self.root + '/sound')
        for name in ['inverse poses', 'centre', 'scores in per cent']:
            MISTAKES[name][1](sequence)
        sequence.write(self.root + '/data')
        self.assertEqual(sorted(check(self.root + '/data')), ['box_centre', 'inverse_poses', 'score_percent'])

    def test_sound_data_raise_no_alarm(self):
        for kind, seed in [('halv', 2), ('halv', 3), ('halv', 4), ('street', 7), ('lot', 7)]:
            folder = f'{self.root}/{kind}{seed}'
            simulate(folder, kind, '--seed', str(seed), *(['--case', str(seed)] if kind == 'halv' else []))
            self.assertEqual(check(folder), [], folder)

    def test_a_run_warns_and_is_otherwise_the_same(self):
        simulate(self.root + '/sound', 'halv', '--case', '4', '--seed', '7')
        sequence = Sequence(self.root + '/sound')
        MISTAKES['inverse poses'][1](sequence)
        sequence.write(self.root + '/data')
        warned = call('run', self.root + '/data', '--out', self.root + '/a')
        silent = call('run', self.root + '/data', '--out', self.root + '/b', '--no-check')
        self.assertEqual((warned.returncode, silent.returncode), (0, 0), warned.stderr + silent.stderr)
        self.assertIn('check: inverse_poses', warned.stderr)
        self.assertNotIn('check:', silent.stderr)
        for name in ['trajectory_tum.txt', 'map.json', 'loops.csv', 'metrics.json']:
            self.assertEqual(read(f'{self.root}/a/{name}'), read(f'{self.root}/b/{name}'), name)

    def test_says_what_cannot_be_tested(self):
        os.makedirs(self.root + '/data')
        with open(self.root + '/data/odometry.txt', 'w') as file:
            file.writelines(f'{0.1 * i:.1f} 0 0 {i} 0 0 0 1\n' for i in range(20))
        with open(self.root + '/data/detections.txt', 'w') as file:
            file.write('0 -1 Car -1 -1 -10 -1 -1 -1 -1 1.5 2 4 1 2 10 0 0.9\n')
        result = call('check', self.root + '/data')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('not testable', result.stdout)
        self.assertIn('no mistake found', result.stdout)
        refused = call('check', self.root + '/data', '--fix', self.root + '/out')
        self.assertEqual(refused.returncode, 3)
        self.assertIn('nothing to correct', refused.stderr)


def kitti_sequence(name, folder):
    """A drive of KITTI tracking as a sequence folder."""
    shutil.copy(f'{KITTI}/calib/{name}.txt', folder + '/calib.txt')
    with open(folder + '/sequence.yaml', 'w') as file:
        file.write('image_size_px: [1242, 375]\nlabels: {Car: {symmetry: none}}\n')
    poses = [[float(x) for x in line.split()] for line in read(f'{KITTI}/orbslam3_poses/{name}.txt').splitlines()]
    with open(folder + '/odometry.txt', 'w') as odometry, open(folder + '/times.txt', 'w') as times:
        for i, p in enumerate(poses):
            q = quaternion([p[0:3], p[4:7], p[8:11]])
            odometry.write(' '.join('%.9g' % x for x in [0.1 * i, p[3], p[7], p[11], *q]) + '\n')
            times.write('%.1f\n' % (0.1 * i))
    with open(folder + '/detections.txt', 'w') as file:
        for line in read(f'{KITTI}/det_pointrcnn_car/{name}.txt').splitlines():
            f = line.split(',')
            file.write(' '.join([f[0], '-1', 'Car', '-1', '-1', f[14], *f[2:6], *f[7:14], f[6]]) + '\n')


if __name__ == '__main__':
    main()
