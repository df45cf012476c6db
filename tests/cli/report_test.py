#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run draw and report: what they write, and what goes wrong. usage: see cli_case.main"""
import os

from cli_case import CliCase, call, read, write, main


class DrawTest(CliCase):
    def setUp(self):
        super().setUp()
        self.run_data('--groundtruth', 'groundtruth.txt', '--quiet')
        self.picture = self.data + '/map.svg'

    def not_drawn(self, result, code, *messages):
        self.assertEqual((result.returncode, os.path.exists(self.picture)), (code, False), result.stderr)
        for message in messages:
            self.assertIn(message, result.stderr)

    def test_pictures(self):
        self.assertEqual(call('draw', self.out, '--out', self.picture).stdout, f'wrote {self.picture}\n')
        for word in ('odometry', 'corrected', 'ground truth', 'Car', ' m</text>'):
            self.assertIn(word, read(self.picture))
        png = self.data + '/map.png'
        self.assertEqual(call('draw', self.out, '--out', png, '--size', 300, '--before-after').returncode, 0)
        with open(png, 'rb') as file:
            header = file.read(24)
        self.assertEqual((header[:4], int.from_bytes(header[16:20], 'big')), (b'\x89PNG', 600))

    def test_what_cannot_be_drawn(self):
        draw = ('draw', self.out, '--out', self.picture)
        self.not_drawn(call('draw', self.data, '--out', self.picture), 3, 'holds no map.json')
        self.not_drawn(call(*draw, '--loop', 3), 2, 'no accepted loop')
        self.not_drawn(call(*draw[:3], self.data + '/map.gif'), 2, 'ends with .svg or .png')
        self.not_drawn(call(*draw, '--groundtruth', self.data + '/none.txt'), 3, 'none.txt')
        write(self.out + '/map.json', read(self.out + '/map.json') + ' ')
        self.not_drawn(call(*draw), 3, 'map.json: is not the file')


if __name__ == '__main__':
    main()
