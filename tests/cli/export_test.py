#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run export: each format read back on its own, and what goes wrong. usage: see cli_case.main"""
import json
import os
import re

from cli_case import CliCase, call, read, write, main


class ExportCase(CliCase):
    """The map of a street, with a loop: the run is not long enough to find one itself."""

    def setUp(self):
        super().setUp()
        self.assertEqual(self.run_data().returncode, 0)
        self.file = self.data + '/exported'

    def export(self, ending, *args):
        """The path of the file written."""
        result = call('export', self.out, '--out', self.file + ending, *args)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, f'wrote {self.file + ending}\n', ''))
        return self.file + ending

    def objects(self):
        return [each for each in json.loads(read(self.out + '/map.json'))['objects'] if each['state'] == 'confirmed']


def read_ply(path):
    """{element: rows of fields as text}, and the header's lines."""
    header, body = read(path).split('end_header\n')
    rows, elements = body.splitlines(), {}
    for name, count in re.findall(r'element (\w+) (\d+)', header):
        elements[name], rows = [row.split() for row in rows[:int(count)]], rows[int(count):]
    assert not rows, 'more rows than the header says'
    return elements, header.splitlines()


class FormatsTest(ExportCase):
    def test_ply(self):
        elements, header = read_ply(self.export('.ply'))
        self.assertEqual(header[:2], ['ply', 'format ascii 1.0'])
        vertices = elements['vertex']
        self.assertEqual({len(row) for row in vertices}, {6})
        for face in elements['face']:
            self.assertEqual(len(face), 1 + int(face[0]))
            self.assertLess(max(map(int, face[1:])), len(vertices))
        for edge in elements['edge']:
            self.assertEqual(vertices[int(edge[0])][3:], edge[2:], 'edges have the colour of their ends')
        self.assertGreaterEqual(len(elements['face']), 6 * len(self.objects()))
        self.assertGreaterEqual(len(elements['edge']), 2 * 39)

    def test_g2o(self):
        graph = self.export('.g2o')
        self.assertEqual(read(graph), read(self.out + '/graph.g2o'))
        solved = json.loads(call('graph', graph, '--out', self.data + '/solved.g2o', '--json').stdout)
        self.assertEqual((solved['vertices'], solved['edges'] >= 39, solved['converged']), (40, True, 1))


class RefusalsTest(ExportCase):
    def not_exported(self, code, *messages, run=None, ending='.ply', args=()):
        result = call('export', run or self.out, '--out', self.file + ending, *args)
        self.assertEqual((result.returncode, result.stdout, os.path.exists(self.file + ending)), (code, '', False), result.stderr)
        for message in messages:
            self.assertIn(message, result.stderr)

    def test_what_cannot_be_exported(self):
        self.not_exported(2, 'the ending chooses the format: .ply, .g2o', ending='.obj')
        self.not_exported(2, 'the ending chooses the format', ending='')
        self.not_exported(3, 'holds no map.json', run=self.data)
        self.not_exported(3, 'holds no map.json', run=self.root + '/none', ending='.g2o')
        before = read(self.out + '/map.ply')
        result = call('export', self.out, '--out', self.out + '/map.ply')
        self.assertEqual(result.returncode, 2)
        self.assertIn('map.ply: is read, and would be overwritten', result.stderr)
        self.assertEqual(read(self.out + '/map.ply'), before)
        self.assertEqual(call('export', self.out, '--out', self.root + '/none/a.ply').returncode, 1)
        write(self.out + '/graph.g2o', 'VERTEX_SE3:QUAT')
        self.not_exported(3, 'graph.g2o: is not the file', ending='.g2o')


if __name__ == '__main__':
    main()
