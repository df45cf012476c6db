# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the command line share: the binaries and a folder with good data for each test."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

binaries = {}


def call(*args, **kwargs):
    return subprocess.run([binaries['run'], *map(str, args)], capture_output=True, text=True, timeout=60, **kwargs)


def read(path):
    with open(path) as file:
        return file.read()


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w') as file:
        file.write(text)


class CliCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp(prefix='sslcd_cli_')
        cls.good = cls.root + '/good'
        subprocess.run([binaries['sim'], 'street', '--out', cls.good, '--seed', '7', '--frames', '40'], check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.root)

    def setUp(self):
        self.data = f'{self.root}/{self.id().split(".")[-1]}/data'
        self.out = f'{self.root}/{self.id().split(".")[-1]}/out'
        shutil.copytree(self.good, self.data)

    def tearDown(self):
        for folder, _, files in os.walk(self.root):
            for name in files:
                self.assertNotIn('.tmp-', name, f'half-written file in {folder}')

    def run_data(self, *args):
        """Runs it; what an earlier run of the same test has written is replaced."""
        return call('run', self.data, '--out', self.out, '--force', *args)

    def edit(self, name, change):
        """Applies `change` to the list of lines of a file."""
        lines = read(f'{self.data}/{name}').splitlines()
        lines = change(lines) or lines
        write(f'{self.data}/{name}', '\n'.join(lines) + '\n')

    def edit_field(self, name, row, column, value):
        def change(lines):
            fields = lines[row].split()
            fields[column] = value
            lines[row] = ' '.join(fields)
        self.edit(name, change)

    def refused(self, result, code, *messages):
        self.assertEqual(result.returncode, code, result.stderr)
        for message in messages:
            self.assertIn(message, result.stderr)
        self.assertFalse(os.path.exists(self.out + '/map.json'), 'a refused run must leave no result')


def main():
    """usage: *_test.py SSLCD_RUN SSLCD_SIM [unittest arguments]"""
    binaries['run'], binaries['sim'] = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
