# SPDX-License-Identifier: BSD-3-Clause
"""The part `change`: arrivals and departures between sessions, by bench/change_bench."""
import csv
import os
import subprocess

from store import fingerprint

CASES = [(str(case), layout) for layout in ('lot', 'street') for case in (1, 2, 3, 4)]
CHURN = {'0.3': ['21', '23'], '0.6': ['21', '22']}  # first and last seed
STILL = [('victoria-park', 'development'), ('kitti-odometry-poles/00', 'development'),
         ('kitti-odometry-poles/05', 'development'), ('forest-evo-fwd', 'development'),
         ('forest-venman3-fwd', 'held-out')]
SESSIONS = '4'


def rows_of(program, *arguments):
    done = subprocess.run([program.beside('bench/change_bench'), *arguments], check=True,
                          stdout=subprocess.PIPE, text=True)
    return list(csv.DictReader(done.stdout.splitlines()))


class Churn:
    """HALV-sim cases in three sessions, with a share of the vehicles replaced between them."""
    missing = None
    role = 'held-out'

    def __init__(self, churn):
        self.churn, self.name = churn, f'change/HALV-sim {churn}'

    def fingerprint(self):
        return fingerprint([], self.churn, *CHURN[self.churn], *sum(CASES, ()))

    def measure(self, program):
        figures = {}
        for case, layout in CASES:
            sums = figures.setdefault(layout, {})
            for row in rows_of(program, 'halv', case, layout, self.churn, *CHURN[self.churn]):
                sums['maps'] = sums.get('maps', 0) + (row['step'] == '1')
                sums['joined'] = sums.get('joined', 0) + (row['step'] == '1' and row['joined'] == '1')
                for what in ('departures', 'arrivals'):
                    for name in (what, f'{what} found', f'wrong {what}'):
                        key = name.replace(' ', '_')
                        sums[key] = sums.get(key, 0) + int(row[name])
        return figures


class Still:
    """A drive on which nothing changes, cut into sessions."""

    def __init__(self, data, name, role):
        self.name, self.role, self.inputs = 'change/' + name, role, [f'{data}/{name}']
        self.missing = next((path for path in self.inputs if not os.path.exists(path)), None)

    def fingerprint(self):
        return fingerprint(self.inputs, SESSIONS)

    def measure(self, program):
        row, = rows_of(program, 'still', self.inputs[0], SESSIONS)
        return {name.replace(' ', '_'): int(value) for name, value in row.items()}


def change_sets(data):
    return [Churn(churn) for churn in CHURN] + [Still(data, *one) for one in STILL]
