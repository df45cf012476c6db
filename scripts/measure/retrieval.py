# SPDX-License-Identifier: BSD-3-Clause
"""The part `retrieval`: which of many maps is a stretch from? By bench/retrieval_bench."""
import os
import tempfile

from program import rounded
from sessions import HELD_OUT, REAL, rows_of
from store import fingerprint

SITES = {4: 100, 260: 100, 10000: 100, 26200: 10}  # number of sites: queries of each kind and noise
REAL_AMONG, SHARE, STRETCH_M = '10000', '0.5', '100'


class Generated:
    """Car parks, streets and trees: an index of so many sites, and stretches through them."""
    missing, role = None, 'development'

    def __init__(self, sites, queries):
        self.name, self.sites, self.queries = f'retrieval/{sites} sites', sites, queries

    def fingerprint(self):
        return fingerprint([], self.sites, self.queries)

    def measure(self, program):
        with tempfile.TemporaryDirectory() as folder:
            rows = rows_of(program, 'retrieval_bench', 'sites', str(self.sites), str(self.queries),
                           folder + '/generated.sites')
        *kinds, file = rows
        figures = {row['run']: {name.replace(' ', '_'): rounded(float(value))
                                for name, value in row.items() if name != 'run'} for row in kinds}
        names = ['sites', 'objects', 'bytes_an_object', 'build_s', 'open_s']
        figures['file'] = {name: rounded(float(value))
                           for name, value in zip(names, list(file.values())[1:])}
        return figures


class Drives:
    """The first half of each real drive is a map among the generated ones."""
    name, role = 'retrieval/real', 'held-out'

    def __init__(self, folder):
        self.drives = [(f'{folder}/{name}', truth) for name, truth in REAL + HELD_OUT]
        self.inputs = [path for path, _ in self.drives]
        self.missing = next((path for path in self.inputs if not os.path.exists(path)), None)

    def fingerprint(self):
        return fingerprint(self.inputs, REAL_AMONG, SHARE, STRETCH_M)

    def measure(self, program):
        named = [word for drive in self.drives for word in drive]
        with tempfile.TemporaryDirectory() as folder:
            rows = rows_of(program, 'retrieval_bench', 'real', REAL_AMONG, SHARE, STRETCH_M,
                           folder + '/real.sites', *named)
        names = [name for name, _ in REAL + HELD_OUT]
        return {name: {key.replace(' ', '_'): rounded(float(value))
                       for key, value in row.items() if key != 'run'}
                for name, row in zip(names, rows)}


def retrieval_sets(data):
    generated = [Generated(*one) for one in SITES.items()]
    return [*generated[:-1], Drives(data), generated[-1]]  # the slowest one last
