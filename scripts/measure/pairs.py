# SPDX-License-Identifier: BSD-3-Clause
"""The part `pairs`: `sslcd_run match` on pairs of layouts with known transform. Counts answers that
are right, wrong or refused."""
import csv
import io
import math
import os
import subprocess
import sys
import tempfile

from program import rounded
from store import fingerprint

RIGHT_M, RIGHT_RAD = 1., math.radians(5)  # of an answer, at the centre of the local map
MAKER = 'bench/make_object_pairs.py'
HELD_OUT_SEEDS = [101, 102]  # no threshold was chosen on them


def read_truth(path):
    """The scene, the absence of the place from the map, the true pose and the points of the local map,
    by number of the pair."""
    pairs = {}
    with open(path, encoding='utf-8') as file:
        for line in file:
            words = line.split()
            if words[:1] == ['PAIR']:
                scene = words[2]
                pair = {'scene': scene.split('/')[0], 'points': [],
                        'absent': 'absent' in scene or 'elsewhere' in scene,
                        'yaw': float(words[5]), 'x': float(words[6]), 'y': float(words[7])}
                pairs[int(words[1])] = pair
            elif words[:1] == ['L']:
                pair['points'].append((float(words[3]), float(words[4])))
    return pairs


def placed(centre, yaw, x, y):
    c, s = math.cos(yaw), math.sin(yaw)
    return c * centre[0] - s * centre[1] + x, s * centre[0] + c * centre[1] + y


def is_right(pair, yaw, x, y):
    """Whether a pose brings the local map's centre within 1 m and its heading within 5 degrees of
    the truth."""
    if pair['absent']:
        return False
    centre = [sum(p[axis] for p in pair['points']) / len(pair['points']) for axis in (0, 1)]
    off_m = math.dist(placed(centre, yaw, x, y),
                      placed(centre, pair['yaw'], pair['x'], pair['y']))
    off_rad = abs((yaw - pair['yaw'] + math.pi) % (2 * math.pi) - math.pi)
    return off_m < RIGHT_M and off_rad < RIGHT_RAD


def count_answers(pairs, answers):
    """{scene: {pairs, right, wrong, refused, ms_p50}} of the rows that `match` prints."""
    counts, times = {}, {}
    for pair in pairs.values():
        scene = counts.setdefault(pair['scene'], {'pairs': 0, 'right': 0, 'wrong': 0, 'refused': 0})
        scene['pairs'] += 1
    for row in csv.DictReader(io.StringIO(answers)):
        pair = pairs[int(row['pair'])]
        times.setdefault(pair['scene'], []).append(float(row['ms']))
        verdict = 'refused'
        if row['decision'] == 'accepted':
            pose = [float(row[name]) for name in ('yaw_rad', 'tx', 'ty')]
            verdict = 'right' if is_right(pair, *pose) else 'wrong'
        counts[pair['scene']][verdict] += 1
    for scene, values in times.items():
        counts[scene]['ms_p50'] = rounded(sorted(values)[len(values) // 2])
    return counts


class Pairs:
    """A file of pairs, or a seed to make one from."""

    def __init__(self, name, role, path=None, seed=None):
        self.name, self.role, self.path, self.seed = name, role, path, seed
        self.arguments = [path or f'pairs of {MAKER} {seed}']
        self.missing = path if path and not os.path.exists(path) else None
        if seed is not None and not self._numpy():
            self.missing = f'NumPy, which {MAKER} needs'

    @staticmethod
    def _numpy():
        return subprocess.run([sys.executable, '-c', 'import numpy'], capture_output=True,
                              check=False).returncode == 0

    def fingerprint(self):
        return fingerprint([self.path or MAKER], self.seed)

    def measure(self, program):
        with tempfile.TemporaryDirectory() as folder:
            path = self.path
            if path is None:
                path = os.path.join(folder, 'pairs.txt')
                subprocess.run([sys.executable, '-B', MAKER, str(self.seed), path], check=True)
            answers, cost = program.run(['match', path, '--quiet'])
            return {**count_answers(read_truth(path), answers), **cost}


def pair_sets(data):
    return [Pairs('pairs/pairs_seed7', 'development', f'{data}/object-pairs/pairs_seed7.txt')] + [
        Pairs(f'pairs/seed {seed}', 'held-out', seed=seed) for seed in HELD_OUT_SEEDS]
