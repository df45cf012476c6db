# SPDX-License-Identifier: BSD-3-Clause
"""The part `stream`: a host in real time with an AsyncMapper, by bench/stream_bench."""
import csv
import os
import subprocess
import tempfile

from program import rounded
from store import fingerprint

PACE_MS, BUDGET_MS = 30, 5
REAL = [('victoria-park', 'reference.txt'), ('kitti-odometry-poles/02', 'groundtruth.txt')]
HALV = [(1, 101), (2, 101)]  # case and seed


def figures_of(text):
    """Of the rows of the lap and of the whole run that stream_bench prints."""
    rows = list(csv.reader(text.splitlines()))
    found = dict(zip(rows[0] + rows[2], rows[1] + rows[3]))
    return {name.replace(' ', '_'): rounded(float(value)) for name, value in found.items()
            if name != 'lap'}


class Stream:
    """One drive in real time."""

    def __init__(self, name, inputs, truth, case=None):
        self.name, self.role, self.inputs = name, 'development', inputs
        self.truth, self.case = truth, case
        self.arguments = [str(PACE_MS), str(BUDGET_MS)]
        self.missing = next((path for path in inputs if not os.path.exists(path)), None)

    def fingerprint(self):
        return fingerprint(self.inputs, *self.arguments, *map(str, self.case or ()))

    def measure(self, program):
        bench = program.beside('bench/stream_bench')
        with tempfile.TemporaryDirectory() as made:
            if self.case:
                case, seed = self.case
                subprocess.run([program.beside('apps/sslcd_sim'), 'halv', '--case', str(case),
                                '--seed', str(seed), '--out', made], check=True,
                               stdout=subprocess.DEVNULL)
            folder = made if self.case else self.inputs[0]
            done = subprocess.run([bench, folder, self.truth, *self.arguments], check=True,
                                  stdout=subprocess.PIPE, text=True)
        return figures_of(done.stdout)


def stream_sets(data):
    real = [Stream('stream/' + name, [f'{data}/{name}'], truth) for name, truth in REAL]
    return real + [Stream(f'stream/HALV-sim {case}', [], 'groundtruth.txt', (case, seed))
                   for case, seed in HALV]
