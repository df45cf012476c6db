# SPDX-License-Identifier: BSD-3-Clause
"""The part `soak`: 10^5 frames of real sequences through the streaming interface, by
bench/soak_bench."""
import csv
import os
import subprocess

from program import rounded
from store import fingerprint

SEQUENCES = ['victoria-park', 'kitti-odometry-poles/00', 'kitti-odometry-poles/02',
             'kitti-odometry-poles/05']
ROUNDS = 8


def figures_of(text):
    """The rows that soak_bench prints."""
    header, *rows = csv.reader(text.splitlines())
    names = [name.replace(' ', '_') for name in header]

    def value(cell):
        return cell if cell in ('yes', 'no') else rounded(float(cell))

    return {'rounds': [dict(zip(names, map(value, row))) for row in rows]}


class Soak:
    """A mapper for each sequence over and over, or one mapper for all of them once."""
    role = 'held-out'

    def __init__(self, name, rounds, shared, inputs):
        self.name, self.inputs = name, inputs
        self.arguments = [str(rounds), str(int(shared))]
        self.missing = next((path for path in inputs if not os.path.exists(path)), None)

    def fingerprint(self):
        return fingerprint(self.inputs, *self.arguments)

    def measure(self, program):
        done = subprocess.run([program.beside('bench/soak_bench'), *self.arguments, *self.inputs],
                              check=True, stdout=subprocess.PIPE, text=True)
        return figures_of(done.stdout)


def soak_sets(data):
    inputs = [f'{data}/{name}' for name in SEQUENCES]
    return [Soak('soak/a mapper each', ROUNDS, False, inputs),
            Soak('soak/one mapper', 1, True, inputs)]
