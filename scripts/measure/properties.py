# SPDX-License-Identifier: BSD-3-Clause
"""The part `properties`: changes of the input that should change no result, by the tests
WorldProperties of tests/pipeline, on 20 drives of HALV-sim and on poles 05."""
import csv
import os
import subprocess
import tempfile

from program import rounded
from store import fingerprint

SEEDS = 20
COLUMNS = ['property', 'drive', 'loops', 'loops_changed', 'in_common', 'wrong', 'wrong_changed', 'ate',
           'ate_changed', 'farthest_m', 'farthest_loop_m']


def figures_of(path):
    """Sums over the drives by property, in the order of the tests."""
    with open(path, encoding='utf-8') as file:
        rows = [dict(zip(COLUMNS, row)) for row in csv.reader(file)]
    figures = {}
    for name in dict.fromkeys(row['property'] for row in rows):
        some = [row for row in rows if row['property'] == name]
        one = {key: sum(int(row[key]) for row in some)
               for key in ('loops', 'loops_changed', 'in_common', 'wrong', 'wrong_changed')}
        for key in ('ate', 'ate_changed'):
            one[key] = rounded(sum(float(row[key]) for row in some) / len(some))
        one['farthest_m'] = rounded(max(float(row['farthest_m']) for row in some))
        figures[name] = {'drives': len(some), **one}
    return figures


class Properties:
    """All properties on some drives."""
    role = 'held-out'

    def __init__(self, name, folder=''):
        self.name, self.folder = name, folder
        self.missing = folder if folder and not os.path.isdir(folder) else None

    def fingerprint(self):
        return fingerprint([self.folder] if self.folder else [], SEEDS)

    def measure(self, program):
        with tempfile.TemporaryDirectory() as folder:
            rows = folder + '/rows.csv'
            seeds = {'SSLCD_PROPERTY_DATA': self.folder} if self.folder else {}
            done = subprocess.run(
                [program.beside('tests/pipeline/sslcd_pipeline_tests'),
                 '--gtest_filter=WorldProperties.*'], check=False, stdout=subprocess.PIPE, text=True,
                env={**os.environ, 'SSLCD_PROPERTY_ROWS': rows,
                     'SSLCD_PROPERTY_SEEDS': '1' if self.folder else str(SEEDS), **seeds})
            if done.returncode not in (0, 1):
                raise SystemExit(f'{self.name}: the test has crashed:\n{done.stdout}')
            if done.returncode:  # a property that does not hold is a figure, too
                print(done.stdout)
            return figures_of(rows)


def property_sets(data):
    return [Properties('properties/halv'),
            Properties('properties/poles 05', f'{data}/kitti-odometry-poles/05')]
