#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run map diff and relocalise: what has changed in a map, and where a drive is in it. usage: see cli_case.main"""
import contextlib
import json
import os
import sqlite3
import statistics
import subprocess

from cli_case import binaries, call, main, read, write
from map_case import MapCase


class MapQuestionsTest(MapCase):
    # Changes
    def street(self, without=()):
        """A drive, or the same without the detections of some objects. Returns the true ids of its rows."""
        subprocess.run([binaries['sim'], 'street', '--out', self.data, '--seed', '7', '--frames', '100', '--force'],
                       check=True, capture_output=True)
        ids = [int(line) for line in read(self.data + '/landmark_ids.txt').split()]
        for name in ('detections.txt', 'landmark_ids.txt'):
            lines = read(f'{self.data}/{name}').splitlines()
            write(f'{self.data}/{name}', ''.join(line + '\n' for line, i in zip(lines, ids) if i not in without))
        return ids

    def test_diff(self):
        ids = self.street()
        self.assertEqual(self.add('--session', 'mo').returncode, 0)
        self.refused(call('map', 'diff', self.map), 2, "one session only, 'mo'", 'add another drive')
        with contextlib.closing(sqlite3.connect(self.map)) as reader:
            cars = reader.execute("SELECT id, x, z FROM landmark WHERE state = 'confirmed' AND label = 'Car' "
                                  "ORDER BY sightings DESC LIMIT 3 OFFSET 2").fetchall()
            gone = [statistics.mode(ids[row] for row, in reader.execute(
                'SELECT detection FROM sighting WHERE landmark = ?', (car,))) for car, _, _ in cars]
        self.assertEqual(self.add('--session', 'tu').returncode, 0)
        same = call('map', 'diff', self.map)
        self.assertEqual(same.returncode, 0, same.stderr)
        self.assertIn("from 'mo' to 'tu': 0 changes", same.stdout)
        self.street(without=gone)
        self.assertEqual(self.add('--session', 'we').returncode, 0)
        told = call('map', 'diff', self.map, '--json')
        self.assertEqual(told.returncode, 0, told.stderr)
        diff = json.loads(told.stdout)
        self.assertEqual((diff['from'], diff['to']), ('tu', 'we'))
        self.assertEqual([c['change'] for c in diff['changes']], ['departed'] * 3)
        for change in diff['changes']:
            x, _, z = change['position']
            self.assertLess(min(abs(x - car[1]) + abs(z - car[2]) for car in cars), 2)
            self.assertGreater(change['probability'], 0.6)
            self.assertEqual(change['to']['seen'], 0)
            self.assertGreater(change['to']['expected'], 5)
        self.assertGreater(diff['stayed'], 10)
        table = call('map', 'diff', self.map, '--from', 'mo', '--to', 'we', '--csv', self.out + '.csv')
        self.assertIn("from 'mo' to 'we': 3 changes", table.stdout)
        rows = read(self.out + '.csv').splitlines()
        self.assertEqual(len(rows), 4)
        self.assertTrue(rows[1].startswith('departed,'), rows[1])
        self.refused(call('map', 'diff', self.map, '--from', 'su'), 2, "no session 'su'", "'mo', 'tu', 'we'")
        self.refused(call('map', 'diff', self.map, '--from', 'we', '--to', 'mo'), 2, 'is not before')
        self.refused(call('map', 'diff', self.map, '--csv', self.out + '/no/a.csv'), 1, 'a.csv')
        self.refused(call('map', 'diff', self.out + '.csv'), 3, 'not an SQLite')

    def test_diff_of_sessions_that_do_not_meet(self):
        self.copy()
        lines = read(self.data + '/detections.txt').splitlines()
        write(self.data + '/detections.txt', '\n'.join(lines[:1]) + '\n')
        self.assertEqual(self.add('--session', 'blind').returncode, 0)
        self.refused(call('map', 'diff', self.map), 5, 'no place was in view of both', 'map info')

    def relocalise(self, *args):
        return call('relocalise', self.data, '--map', self.made, *args)

    def test_a_drive_is_found_in_a_map(self):
        with open(self.made, 'rb') as file:
            before = file.read()
        out = os.path.dirname(self.data) + '/answers.csv'
        done = self.relocalise('--from', '10', '--out', out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('first: frame ', done.stdout)
        rows = read(out).strip().split('\n')
        self.assertTrue(rows[0].startswith('frame,stamp,path_m,decision,probability,'))
        self.assertIn('accepted', rows[-1])
        told = self.relocalise('--from', '10', '--json', '--first')
        answers = json.loads(told.stdout)
        self.assertEqual([one['decision'] for one in answers].count('accepted'), 1)
        self.assertEqual(answers[-1]['decision'], 'accepted')
        self.assertGreater(answers[-1]['probability'], .99)
        with open(self.made, 'rb') as file:
            self.assertEqual(file.read(), before, 'the map is only read')

    def test_a_drive_is_not_found(self):
        done = self.relocalise('--frames', '2')
        self.assertEqual(done.returncode, 5, done.stdout)
        self.assertRegex(done.stdout, 'not found: .*too few')
        for args, text in ((['--from', '9999'], '--from 9999: the last frame is '),
                           (['--map', self.data + '/none.db'], 'no such map')):
            refused = call('relocalise', self.data, *(args if '--map' in args else ['--map', self.made, *args]))
            self.assertIn(refused.returncode, (2, 3))
            self.assertIn(text, refused.stderr)


if __name__ == '__main__':
    main()
