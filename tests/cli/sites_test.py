#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run sites: an index of maps, and which of them a drive is from. usage: see cli_case.main"""
import json
import os
import shutil
import subprocess

from cli_case import binaries, call, main, read, write
from map_case import MapCase


class SitesTest(MapCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.other = cls.root + '/other'  # another street, as a finished run
        subprocess.run([binaries['sim'], 'street', '--out', cls.other + '_data', '--seed', '8', '--frames', '40'],
                       check=True, capture_output=True)
        done = call('run', cls.other + '_data', '--out', cls.other)
        assert done.returncode == 0, done.stderr
        cls.sites = cls.root + '/all.sites'
        done = call('sites', 'index', cls.other, cls.made, '--out', cls.sites)
        assert done.returncode == 0, done.stderr
        assert '2 sites' in done.stdout, done.stdout

    def find(self, data, *args):
        return call('sites', 'find', data, '--sites', self.sites, *args)

    def test_a_drive_finds_its_map(self):
        for data, site in ((self.data, self.made), (self.other + '_data', self.other + '/map.json')):
            done = self.find(data, '--json')
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(json.loads(done.stdout)[0]['site'], site)
        done = self.find(self.data, '--first', '1')
        self.assertIn(self.made, done.stdout)
        self.assertNotIn('map.json', done.stdout)
        self.assertEqual(self.find(self.data, '--from', '5', '--frames', '30').returncode, 0)

    def test_the_localiser_verifies(self):
        done = self.find(self.data, '--verify', '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        first = json.loads(done.stdout)[0]
        self.assertEqual(first['site'], self.made)
        self.assertTrue(first['verified']['accepted'], first)
        self.assertIn('the drive is from ' + self.made, self.find(self.data, '--verify').stdout)
        other = self.other + '_data'
        none = self.find(other, '--verify', '--first', '1')  # in a map.json nothing is localised
        self.refused(none, 3, 'none of the sites could be verified', 'map.json')
        self.assertIn('not verified: ', none.stdout)
        row = json.loads(self.find(other, '--verify', '--first', '1', '--json').stdout)[0]
        self.assertIn('map.json', row['verified']['error'])
        refused = call('sites', 'find', other, '--sites', self.only_made(), '--verify')
        self.assertEqual(refused.returncode, 5, refused.stdout)
        self.assertRegex(refused.stdout, 'refused: |no site has')

    def only_made(self):
        sites = os.path.dirname(self.data) + '/made.sites'
        self.assertEqual(call('sites', 'index', self.made, '--out', sites).returncode, 0)
        return sites

    def test_no_site(self):
        lines = read(self.data + '/detections.txt').splitlines()
        write(self.data + '/detections.txt', '\n'.join(lines[:3]) + '\n')
        done = self.find(self.data)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn('no site has objects as in this drive', done.stdout)
        self.assertEqual(self.find(self.data, '--json').stdout, '[]\n')

    def test_an_index_is_extended_and_folders_are_searched(self):
        folder = os.path.dirname(self.data) + '/maps'
        os.makedirs(folder)
        shutil.copy(self.made, folder + '/a.db')
        shutil.copytree(self.other, folder + '/b')
        all_at_once, one, two = (f'{folder}/{name}.sites' for name in ('all', 'one', 'two'))
        self.assertEqual(call('sites', 'index', folder, '--out', all_at_once).returncode, 0)
        self.assertEqual(call('sites', 'index', folder + '/a.db', '--out', one).returncode, 0)
        self.assertEqual(call('sites', 'index', folder + '/b', '--add', one, '--out', two).returncode, 0)
        with open(all_at_once, 'rb') as first, open(two, 'rb') as second:
            self.assertEqual(first.read(), second.read())
        self.refused(call('sites', 'index', folder + '/b', '--add', two, '--out', one), 3, 'in the index already')
        map_json = json.loads(read(self.other + '/map.json'))
        map_json['objects'] = []
        write(folder + '/empty.json', json.dumps(map_json))
        empty = call('sites', 'index', folder + '/empty.json', '--out', one)
        self.assertEqual(empty.returncode, 0, empty.stderr)
        self.assertIn('no confirmed landmarks', empty.stderr)

    def test_refused(self):
        out = os.path.dirname(self.data) + '/no.sites'
        self.refused(call('sites', 'index', self.made, self.root + '/./made.db', '--out', out), 2, 'is named twice')
        self.refused(call('sites', 'index', self.made, '--out', self.made), 2, 'made.db')
        self.refused(call('sites', 'index', self.root + '/no.db', '--out', out), 3, 'no.db')
        self.refused(call('sites', 'index', self.data, '--out', out), 3, 'no map.json')
        self.refused(call('sites', 'index', self.made, '--out', self.root + '/no/folder'), 1, 'no/folder')
        self.assertFalse(os.path.exists(out))
        self.refused(call('sites', 'find', self.data, '--sites', self.made), 3, 'is no index of sites')
        self.refused(call('sites', 'find', self.data, '--sites', out), 3, 'no.sites', 'sites index')
        self.refused(self.find(self.data, '--from', '400'), 2, 'the last frame is 39')
        with open(self.sites, 'rb') as file:
            good = file.read()
        for bad, problem in ((good[:-5], 'cut short'), (good[:5000] + b'x' + good[5001:], 'damaged')):
            with open(out, 'wb') as file:
                file.write(bad)
            self.refused(call('sites', 'find', self.data, '--sites', out), 3, problem)


if __name__ == '__main__':
    main()
