#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what may be trusted. Called by scripts/trust.sh, which says what it does."""
import argparse
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
BINS = [-math.inf, 0, 1, 2, 3, 5, 7, math.inf]  # of the score [nats]


def is_harmed(row, part):
    return row[part] > 1.02 * row[part + '_odometry'] + 0.02


def matrices(path):
    """T_world_cam of a file of TUM rows."""
    rows = np.loadtxt(path)
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :3, 3] = rows[:, 1:4]
    for pose, row in zip(poses, rows):
        pose[:3, :3] = rotation(row[4:8])
    return poses


def rotation(quaternion):
    x, y, z, w = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def loops_of(run, sequence):
    """(score, accepted, right) of each row of loops.csv. Up is -y of the camera."""
    truth = matrices(next(p for p in (sequence / 'groundtruth.txt', sequence / 'reference.txt')
                          if p.exists()))
    found = []
    with open(run / 'loops.csv', encoding='utf-8') as rows:
        for row in csv.DictReader(rows):
            if not row['tx']:
                continue
            query, match = int(row['query_frame']), int(row['match_frame'])
            measured = np.eye(4)
            measured[:3, 3] = [float(row[k]) for k in ('tx', 'ty', 'tz')]
            measured[:3, :3] = rotation([float(row[k]) for k in ('qx', 'qy', 'qz', 'qw')])
            error = np.linalg.inv(truth[query]) @ truth[match] @ measured
            angle = math.degrees(math.acos(np.clip((np.trace(error[:3, :3]) - 1) / 2, -1, 1)))
            right = (math.hypot(error[0, 3], error[2, 3]) < RIGHT_M and angle < RIGHT_DEG and
                     abs(error[1, 3]) < RIGHT_HEIGHT_M)
            found.append((float(row['score']), row['decision'] == 'accepted', right))
    return found


class Trust:
    def __init__(self, options):
        self.options = options
        self.program = options.build / 'apps' / 'sslcd_run'
        self.generator = options.tools / 'aliased_worlds.py'
        self.judge = options.tools / 'eval_sequence.py'
        for needed in (self.program, self.generator, self.judge):
            if not needed.exists():
                sys.exit(f'no {needed}: see the head of scripts/trust.sh')

    def jobs(self):
        """(name, seed, folder of the sequence); seed 0: real data."""
        names = subprocess.run([sys.executable, self.generator, '--list'], check=True,
                               capture_output=True, text=True).stdout.split()
        wanted = self.options.worlds.split(',')
        jobs = [(n, seed, self.options.out / 'worlds' / f'{n}-s{seed}') for n in names
                for seed in self.options.seeds if any(fnmatch.fnmatch(n, w) for w in wanted)]
        jobs += [(n, 0, self.options.data / n) for n in REAL
                 if any(fnmatch.fnmatch(n, w) for w in wanted)]
        return jobs

    def measure(self, job):
        name, seed, sequence = job
        if seed and not (sequence / 'sequence.yaml').exists():
            subprocess.run([sys.executable, self.generator, sequence.parent, name, str(seed)],
                           check=True, capture_output=True)
        if not sequence.exists():
            return {'name': name, 'seed': seed, 'error': f'no {sequence}'}
        run = self.options.out / 'runs' / f'{name.replace("/", "-")}-s{seed}'
        done = subprocess.run([self.program, 'run', sequence, '--out', run, '--quiet'],
                              capture_output=True, text=True)
        if done.returncode != 0:
            return {'name': name, 'seed': seed, 'error': done.stderr.strip()}
        judged = subprocess.run([sys.executable, self.judge, run, sequence], check=True,
                                capture_output=True, text=True)
        return {'name': name, 'seed': seed, 'rows': loops_of(run, sequence),
                **json.loads(judged.stdout)}


def table_of_runs(results):
    lines = ['| world | runs | loops | wrong | recall | ATE odometry -> result [m] | worse |',
             '|---|---|---|---|---|---|---|']
    for name in dict.fromkeys(r['name'] for r in results):
        some = [r for r in results if r['name'] == name]
        marks = sum(r['revisited_stretches'] for r in some)
        recall = sum(r['recall'] * r['revisited_stretches'] for r in some) / marks if marks else None
        lines.append('| ' + ' | '.join([
            name, str(len(some)), str(sum(r['loops'] for r in some)),
            str(sum(r['wrong_loops'] for r in some)), '-' if recall is None else f'{recall:.2f}',
            ', '.join(f'{r["ate_odometry"]:.2f} -> {r["ate"]:.2f}' for r in some),
            str(sum(is_harmed(r, 'ate') for r in some))]) + ' |')
    return lines


def table_of_scores(results):
    rows = [row for r in results for row in r['rows']]
    lines = ['| score [nats] | loops | expected right | right | accepted |', '|---|---|---|---|---|']
    for low, high in zip(BINS, BINS[1:]):
        some = [row for row in rows if low <= row[0] < high]
        if not some:
            continue
        expected = np.mean([1 / (1 + math.exp(-min(row[0], 50))) for row in some])
        lines.append(f'| {low} to {high} | {len(some)} | {expected:.3f} | '
                     f'{np.mean([row[2] for row in some]):.3f} | {sum(row[1] for row in some)} |')
    return lines


def main():
    parser = argparse.ArgumentParser(prog='scripts/trust.sh')
    parser.add_argument('--build', type=Path)
    parser.add_argument('--data', type=Path)
    parser.add_argument('--tools', type=Path)
    parser.add_argument('--out', type=Path, default=Path('runs/trust'))
    parser.add_argument('--worlds', default='*', help='patterns, separated by commas')
    parser.add_argument('--seeds', default='1,2,3,4,5',
                        type=lambda text: [int(s) for s in text.split(',')])
    parser.add_argument('--jobs', type=int, default=2)
    options = parser.parse_args()
    trust = Trust(options)
    options.out.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(trust.measure, trust.jobs()))
    for failed in (r for r in results if 'error' in r):
        print(f'{failed["name"]}, seed {failed["seed"]}: {failed["error"]}')
    good = [r for r in results if 'error' not in r]
    lines = [*table_of_runs(good), '', *table_of_scores(good)]
    (options.out / 'trust.md').write_text('\n'.join([*lines, '']), encoding='utf-8')
    print('\n'.join(lines))
    wrong = sum(r['wrong_loops'] for r in good)
    worse = [f'{r["name"]}-s{r["seed"]}' for r in good if is_harmed(r, 'ate')]
    print(f'{len(good)} runs, {wrong} wrong loops, {len(worse)} worse than their odometry: '
          f'{", ".join(worse)}')
    return 1 if wrong or worse or len(good) < len(results) else 0


if __name__ == '__main__':
    sys.exit(main())
