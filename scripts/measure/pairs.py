# SPDX-License-Identifier: BSD-3-Clause
"""The parts `pairs` and `city`: `sslcd_run match` on pairs of layouts with known transform, and on
large maps. Counts answers that are right, wrong or refused."""
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
CITY_MAKER = 'bench/make_city.py'
CITY_OBJECTS = [10000, 100000, 1000000]
CITY_QUERIES, CITY_SEED = 60, 201
SURE = 5.  # the score that a place needs that may be absent (SingleLookOptions)


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


def quantile(values, share):
    return sorted(values)[int(share * len(values))]


def count_answers(pairs, answers):
    """{scene: {pairs, right, wrong, refused, right_sure, wrong_sure, ms_p50, ms_p95}} of the rows
    that `match` prints."""
    counts, times = {}, {}
    for pair in pairs.values():
        scene = counts.setdefault(pair['scene'], dict.fromkeys(
            ('pairs', 'right', 'wrong', 'refused', 'right_sure', 'wrong_sure'), 0))
        scene['pairs'] += 1
    for row in csv.DictReader(io.StringIO(answers)):
        pair = pairs[int(row['pair'])]
        times.setdefault(pair['scene'], []).append(float(row['ms']))
        verdict = 'refused'
        if row['decision'] == 'accepted':
            pose = [float(row[name]) for name in ('yaw_rad', 'tx', 'ty')]
            verdict = 'right' if is_right(pair, *pose) else 'wrong'
            counts[pair['scene']][verdict + '_sure'] += float(row['score']) >= SURE
        counts[pair['scene']][verdict] += 1
    for scene, values in times.items():
        counts[scene]['ms_p50'] = rounded(quantile(values, 0.5))
        counts[scene]['ms_p95'] = rounded(quantile(values, 0.95))
    return counts


def has_numpy():
    return subprocess.run([sys.executable, '-c', 'import numpy'], capture_output=True,
                          check=False).returncode == 0


def judge(program, path):
    answers, cost = program.run(['match', path, '--quiet'])
    return {**count_answers(read_truth(path), answers), **cost}


class FileOfPairs:
    def __init__(self, name, role, path):
        self.name, self.role, self.path = name, role, path
        self.arguments = [path]
        self.missing = None if os.path.exists(path) else path

    def fingerprint(self):
        return fingerprint([self.path])

    def measure(self, program):
        return judge(program, self.path)


class MadePairs:
    """Made by a program of bench/ from some words."""

    def __init__(self, name, maker, *words):
        self.name, self.role, self.maker, self.words = name, 'held-out', maker, words
        self.arguments = [f'pairs of {maker} {" ".join(words)}']
        self.missing = None if has_numpy() else f'NumPy, which {maker} needs'

    def fingerprint(self):
        return fingerprint([MAKER, self.maker], *self.words)

    def measure(self, program):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'pairs.txt')
            subprocess.run([sys.executable, '-B', self.maker, *self.words, path], check=True)
            return judge(program, path)


def pair_sets(data):
    known = FileOfPairs('pairs/pairs_seed7', 'development', f'{data}/object-pairs/pairs_seed7.txt')
    return [known] + [MadePairs(f'pairs/seed {seed}', MAKER, str(seed)) for seed in HELD_OUT_SEEDS]


def city_sets(_):
    return [MadePairs(f'city/{scene} {count}', CITY_MAKER, str(count), scene, str(CITY_QUERIES),
                      str(CITY_SEED)) for scene in ('street', 'lot') for count in CITY_OBJECTS]
