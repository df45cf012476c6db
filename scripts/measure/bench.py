# SPDX-License-Identifier: BSD-3-Clause
"""The part `bench`: the paper's tables from `sslcd_run bench`, and the table of rendered images,
which must be in SSLCD_BENCH_IMAGES (docs/halv_sim.md describes how to make them)."""
import csv
import os

from halv import FOLDER
from store import fingerprint

LAYOUT = 'perch-parking-cuboids/very-important-3-cuboids.json'
ALL = ['table1', 'table2', 'table3', 'attempts', 'attempts_churn',
       'attempts_layout-very-important-3-cuboids', 'pr', 'viewpoint', 'ablation']
VIEWPOINTS = '30-45,45-60,60-75,75-90,90-105,105-120,120-135'


def read_table(folder, key):
    """Title, header and rows of a table; numbers stay as they are printed."""
    with open(os.path.join(folder, key + '.md'), encoding='utf-8') as file:
        title = file.readline().strip().strip('*')
    with open(os.path.join(folder, key + '.csv'), encoding='utf-8', newline='') as file:
        header, *rows = csv.reader(file)
    return {'title': title, 'header': header, 'rows': rows}


class Bench:
    """One run of `sslcd_run bench` and its tables."""

    def __init__(self, name, tables, arguments, inputs):
        self.name, self.role, self.tables, self.inputs = name, 'development', tables, inputs
        self.arguments = arguments
        self.missing = next((path for path in inputs if not os.path.exists(path)), None)

    def fingerprint(self):
        words = [word for word in self.arguments if word not in self.inputs]
        return fingerprint(self.inputs, *words)

    def measure(self, program):
        folder = os.path.join(FOLDER, program.built)
        program.run(['bench', *self.arguments, '--out', folder, '--quiet'])
        return {key.replace('-', '_'): read_table(folder, key) for key in self.tables}


def bench_sets(data):
    layout, kitti = f'{data}/{LAYOUT}', f'{data}/kitti-tracking'
    images = os.environ.get('SSLCD_BENCH_IMAGES', 'SSLCD_BENCH_IMAGES (rendered images)')
    return [Bench('bench/all', ALL, ['all', '--layout', layout, '--kitti', kitti], [layout, kitti]),
            Bench('bench/images', ['viewpoint_images'],
                  ['viewpoint', '--seeds', '2', '--viewpoints', VIEWPOINTS, '--methods',
                   'sslcd,appearance', '--images', images], [images])]
