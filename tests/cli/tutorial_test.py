#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The commands of docs/tutorial.md lead from a clone to a picture of people's own loops. usage: see cli_case.main

What git and scripts/build.sh do is left out here; the commands of sslcd_run are called as they stand there."""
import os
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

from cli_case import binaries, main, read
from stereo_world import write_drive

HERE = os.path.dirname(os.path.abspath(__file__))
DATA = HERE + '/../data'
PREFIX = ['git clone', 'sslcd/scripts/build.sh']


def commands_of(name):
    page = read(HERE + '/../../docs/tutorial.md')
    return re.search(rf'<!-- commands of {name} -->\n```\n(.*?)```', page, re.DOTALL).group(1).splitlines()


class TutorialTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix='sslcd_tutorial_')
        os.makedirs(self.folder + '/sslcd/build/release/apps')
        os.symlink(os.path.abspath(binaries['run']), self.folder + '/sslcd/build/release/apps/sslcd_run')

    def tearDown(self):
        shutil.rmtree(self.folder)

    def follow(self, name):
        """Calls all commands but git and build.sh, which exists; returns the picture."""
        commands = commands_of(name)
        self.assertLessEqual(len(commands), 5)
        for begin, command in zip(PREFIX, commands):
            self.assertTrue(command.startswith(begin), command)
        self.assertTrue(os.access(HERE + '/../../scripts/build.sh', os.X_OK))
        for command in commands[len(PREFIX):]:
            result = subprocess.run(shlex.split(command), cwd=self.folder, capture_output=True, text=True, timeout=60)
            if 'which was not found' in result.stderr:
                self.skipTest('skipped: no ONNX Runtime: ' + result.stderr)
            self.assertEqual(result.returncode, 0, command + '\n' + result.stderr)
        return read(self.folder + '/mine.svg')

    def test_a_sequence(self):
        shutil.copytree(DATA + '/sim_out_and_back', self.folder + '/my_sequence')
        picture = self.follow('a sequence')
        rows = read(self.folder + '/runs/mine/loops.csv').splitlines()
        loops = sum(row.split(',')[2] == 'accepted' for row in rows)
        self.assertGreater(loops, 0)
        self.assertIn(f'{loops} loops', re.sub('<[^>]*>', ' ', picture))

    def test_images(self):
        write_drive(self.folder + '/my_images', 3)
        for old, new in (('image_2', 'left'), ('image_3', 'right')):
            os.rename(f'{self.folder}/my_images/{old}', f'{self.folder}/my_images/{new}')
        shutil.copy(DATA + '/models/yolox.onnx', self.folder)
        self.assertIn('<svg', self.follow('images'))


if __name__ == '__main__':
    main()
