# SPDX-License-Identifier: BSD-3-Clause
"""Runs sequences with true poses and judges them, for trust.py and sensitivity.py."""
import csv
import fnmatch
import json
import math
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

REAL = ['victoria-park', 'kitti-odometry-poles/00', 'kitti-odometry-poles/02',
        'kitti-odometry-poles/05', 'forest-evo-fwd', 'forest-venman3-fwd']
RIGHT_M, RIGHT_HEIGHT_M, RIGHT_DEG = 5, 1.5, 5  # as eval_sequence.py


def add_arguments(parser, out):
    """Arguments that all scripts of judged runs have. `out`: default of --out."""
    parser.add_argument('--build', type=Path)
    parser.add_argument('--data', type=Path)
    parser.add_argument('--tools', type=Path)
    parser.add_argument('--out', type=Path, default=Path(out))
    parser.add_argument('--jobs', type=int, default=2)


def numbers(text):
    return [int(number) for number in text.split(',')]


def is_wanted(name, patterns):
    """`patterns`: separated by commas."""
    return any(fnmatch.fnmatch(name, pattern) for pattern in patterns.split(','))


def rotation(quaternion):
    x, y, z, w = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def pose_of(numbers_of_row):
    """tx ty tz qx qy qz qw, as numbers or text."""
    values = [float(value) for value in numbers_of_row]
    pose = np.eye(4)
    pose[:3, 3] = values[:3]
    pose[:3, :3] = rotation(values[3:])
    return pose


def read_tum(path):
    """T_world_cam of a file of TUM rows."""
    with open(path, encoding='utf-8') as rows:
        return [pose_of(row.split()[1:]) for row in rows if row.strip() and row[0] != '#']


def true_poses(sequence):
    """T_world_cam by frame."""
    return read_tum(next(path for path in (sequence / 'groundtruth.txt',
                                           sequence / 'reference.txt') if path.exists()))


def is_right(truth, query, match, T_match_query):
    """`truth`: true T_world_cam by frame. Up is -y of the camera."""
    error = np.linalg.inv(truth[query]) @ truth[match] @ T_match_query
    degrees = math.degrees(math.acos(np.clip((np.trace(error[:3, :3]) - 1) / 2, -1, 1)))
    return bool(math.hypot(error[0, 3], error[2, 3]) < RIGHT_M and degrees < RIGHT_DEG and
                abs(error[1, 3]) < RIGHT_HEIGHT_M)


def read_attempts(run, sequence):
    """Those of RUN/loops.csv that have a probability."""
    truth = true_poses(sequence)
    with open(run / 'loops.csv', encoding='utf-8') as rows:
        return [{'score': float(row['score']), 'probability': float(row['probability']),
                 'accepted': row['decision'] == 'accepted',
                 'right': is_right(truth, int(row['query_frame']), int(row['match_frame']),
                                   pose_of(row[k] for k in ('tx', 'ty', 'tz', 'qx', 'qy', 'qz',
                                                            'qw')))}
                for row in csv.DictReader(rows) if row['probability']]


def logarithm(pose):
    """Translation and rotation vector."""
    R = pose[:3, :3]
    sine_axis = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    angle = math.acos(np.clip((np.trace(R) - 1) / 2, -1, 1))
    return np.r_[pose[:3, 3], sine_axis * (angle / math.sin(angle) if angle > 1e-9 else 1)]


def squared_errors_of_loops(run, sequence):
    """Normalised estimation error squared (NEES) of the loops that their objects have measured: the
    edges of RUN/graph.g2o between frames that are no neighbours. 6 on average if their covariances
    are true."""
    truth = true_poses(sequence)
    squared = []
    with open(run / 'graph.g2o', encoding='utf-8') as lines:
        for words in map(str.split, lines):
            if words[0] != 'EDGE_SE3:QUAT' or abs(int(words[1]) - int(words[2])) < 2:
                continue
            match, query = truth[int(words[1])], truth[int(words[2])]
            error = logarithm(np.linalg.inv(pose_of(words[3:10])) @ np.linalg.inv(match) @ query)
            upper = np.zeros((6, 6))
            upper[np.triu_indices(6)] = [float(word) for word in words[10:31]]
            information = upper + np.triu(upper, 1).T
            squared.append(float(error @ information @ error))
    return squared


class JudgedRuns:
    """The sequences, the program and the judge. `options` are those of add_arguments."""

    def __init__(self, options):
        self.data, self.out, self.threads = options.data, options.out, options.jobs
        self.program = options.build / 'apps' / 'sslcd_run'
        self.generator = options.tools / 'aliased_worlds.py'
        self.judge = options.tools / 'eval_sequence.py'
        for needed in (self.program, self.generator, self.judge):
            if not needed.exists():
                sys.exit(f'no {needed}: see the head of the script')
        self.out.mkdir(parents=True, exist_ok=True)

    def sequences(self, patterns, seeds):
        """(name, seed, folder): worlds with all seeds, then real data with seed 0."""
        names = subprocess.run([sys.executable, self.generator, '--list'], check=True,
                               capture_output=True, text=True).stdout.split()
        worlds = [(name, seed, self.out / 'worlds' / f'{name}-s{seed}') for name in names
                  for seed in seeds if is_wanted(name, patterns)]
        return worlds + [(name, 0, self.data / name) for name in REAL if is_wanted(name, patterns)]

    def generate(self, sequence):
        """Writes a world that is not there."""
        name, seed, folder = sequence
        if seed and not (folder / 'sequence.yaml').exists():
            subprocess.run([sys.executable, self.generator, folder.parent, name, str(seed)],
                           check=True, capture_output=True)

    def measure(self, sequence, folder='runs', settings=()):
        """The judge's figures of a run with `--set` for each of `settings`, and its folder `run`;
        `error` instead of them if there is no run."""
        name, seed, path = sequence
        result = {'name': name, 'seed': seed}
        if not path.exists():
            return {**result, 'error': f'no {path}'}
        run = self.out / folder / f'{name.replace("/", "-")}-s{seed}'
        sets = [part for setting in settings for part in ('--set', setting)]
        done = subprocess.run([self.program, 'run', path, '--out', run, '--force', '--quiet', *sets],
                              capture_output=True, text=True)
        if done.returncode != 0:
            return {**result, 'error': done.stderr.strip()}
        judged = subprocess.run([sys.executable, self.judge, run, path], check=True,
                                capture_output=True, text=True)
        return {**result, 'run': run, **json.loads(judged.stdout)}

    def map(self, function, jobs):
        """Yields results in order of the jobs, which run in parallel."""
        with ThreadPoolExecutor(self.threads) as pool:
            yield from pool.map(function, jobs)
