# SPDX-License-Identifier: BSD-3-Clause
"""The part `sessions`: several sessions on one map, by bench/sessions_bench."""
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


def rows_of(program, *arguments):
    done = subprocess.run([program.beside('bench/sessions_bench'), *arguments], check=True,
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
                for row in rows_of(program, self.inputs[0], self.truth, *ORDERS)}


class Halv:
    """HALV-sim cases recorded twice, with or without a copy of the site in the map."""
    missing = None

    def __init__(self, which):
        self.name, self.role, self.which = f'sessions/HALV-sim {which}', 'held-out', which

    def fingerprint(self):
        return fingerprint([], *SEEDS, *sum(HALV, ()), self.which)

    def measure(self, program):
        rows = [row for case in HALV for row in rows_of(program, self.which, *case, *SEEDS)]
        first = [float(row['first loop m']) for row in rows]
        return {'sessions': len(rows), 'near': sum(0 <= path <= NEAR_M for path in first),
                'wrong': sum(row['wrong'] != '0' for row in rows),
                'to_copy': sum(row['to copy'] != '0' for row in rows)}


def session_sets(data):
    return ([Drive(data, *one, 'development') for one in REAL] +
            [Drive(data, *one, 'held-out') for one in HELD_OUT] + [Halv('halv'), Halv('copy')])
