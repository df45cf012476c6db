# SPDX-License-Identifier: BSD-3-Clause
"""The parts `sessions` and `relocalise`: several sessions on one map, by bench/sessions_bench, and
drives that are found in a map, by bench/relocalise_bench."""
import csv
import os
import subprocess

from program import rounded
from store import fingerprint

REAL = [('victoria-park', 'reference.txt'), ('forest-evo-fwd', 'groundtruth.txt'),
        ('kitti-odometry-poles/00', 'groundtruth.txt'),
        ('kitti-odometry-poles/02', 'groundtruth.txt'),
        ('kitti-odometry-poles/05', 'groundtruth.txt')]
HELD_OUT = [('forest-venman3-fwd', 'groundtruth.txt')]
ORDERS = ['1', '1234', '4321', '2413']  # the first: the whole drive
HALV = [(str(case), layout) for layout in ('lot', 'street') for case in (1, 2, 3, 4)]
SEEDS = ['21', '25']  # first and last
NEAR_M = 50
STRETCHES = ['0.5', '100']  # share of the drive in the map, length of a stretch [m]
MANY_SEEDS = ['21', '45']


def rows_of(program, bench, *arguments):
    done = subprocess.run([program.beside('bench/' + bench), *arguments], check=True,
                          stdout=subprocess.PIPE, text=True)
    return list(csv.DictReader(done.stdout.splitlines()))


class Drive:
    """One drive, whole and as sessions in several orders."""

    def __init__(self, folder, name, truth, role):
        self.name, self.role, self.inputs = 'sessions/' + name, role, [f'{folder}/{name}']
        self.truth = truth
        self.missing = next((path for path in self.inputs if not os.path.exists(path)), None)

    def fingerprint(self):
        return fingerprint(self.inputs, *ORDERS)

    def measure(self, program):
        return {row['run']: {name.replace(' ', '_'): rounded(float(value))
                             for name, value in row.items() if name != 'run'}
                for row in rows_of(program, 'sessions_bench', self.inputs[0], self.truth, *ORDERS)}


class Halv:
    """HALV-sim cases recorded twice, with or without a copy of the site in the map."""
    missing = None

    def __init__(self, which):
        self.name, self.role, self.which = f'sessions/HALV-sim {which}', 'held-out', which

    def fingerprint(self):
        return fingerprint([], *SEEDS, *sum(HALV, ()), self.which)

    def measure(self, program):
        rows = [row for case in HALV
                for row in rows_of(program, 'sessions_bench', self.which, *case, *SEEDS)]
        first = [float(row['first loop m']) for row in rows]
        return {'sessions': len(rows), 'near': sum(0 <= path <= NEAR_M for path in first),
                'wrong': sum(row['wrong'] != '0' for row in rows),
                'to_copy': sum(row['to copy'] != '0' for row in rows)}


def session_sets(data):
    return ([Drive(data, *one, 'development') for one in REAL] +
            [Drive(data, *one, 'held-out') for one in HELD_OUT] + [Halv('halv'), Halv('copy')])


class Stretches:
    """Stretches of the rest of a drive, searched in the map of its first part."""

    def __init__(self, folder, name, truth, role):
        self.name, self.role = 'relocalise/' + name, role
        self.inputs, self.truth = [f'{folder}/{name}'], truth
        self.missing = next((path for path in self.inputs if not os.path.exists(path)), None)

    def fingerprint(self):
        return fingerprint(self.inputs, *STRETCHES)

    def measure(self, program):
        row, = rows_of(program, 'relocalise_bench', self.inputs[0], self.truth, *STRETCHES)
        return {name.replace(' ', '_'): rounded(float(value)) for name, value in row.items()
                if name != 'run'}


class WayBack:
    """The way back of HALV-sim, searched in the map of the way there."""
    missing = None

    def __init__(self, which, churn, seeds):
        self.name, self.role = f'relocalise/HALV-sim {which} {churn}', 'held-out'
        self.which, self.churn, self.seeds = which, churn, seeds

    def fingerprint(self):
        return fingerprint([], *self.seeds, *sum(HALV, ()), self.which, self.churn)

    def measure(self, program):
        rows = [row for case in HALV for row in rows_of(
            program, 'relocalise_bench', self.which, *case, *self.seeds, self.churn)]
        return {'sessions': len(rows), 'near': sum(row['within 50 m'] == '1' for row in rows),
                'found': sum(float(row['path m']) >= 0 for row in rows),
                'wrong': sum(row['wrong'] != '0' for row in rows),
                'p95_ms': rounded(max(float(row['p95 ms']) for row in rows))}


def relocalise_sets(data):
    return ([Stretches(data, *one, 'development') for one in REAL] +
            [Stretches(data, *one, 'held-out') for one in HELD_OUT] +
            [WayBack('halv', '0.3', MANY_SEEDS), WayBack('halv', '0.6', SEEDS),
             WayBack('copy', '0.3', SEEDS)])
