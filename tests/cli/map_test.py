#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run run --map and map: sessions, interruptions, and files that are no map. usage: see cli_case.main"""
import contextlib
import fcntl
import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
import unittest

from cli_case import binaries, call, main, read, write
from map_case import MapCase

sys.dont_write_bytecode = True
from kill_map import KillTest  # noqa: E402

RUN_FILES = ('trajectory_tum.txt', 'map.json', 'graph.g2o', 'loops.csv', 'metrics.json', 'config.yaml', 'map.ply',
             'odometry_tum.txt')


class MapTest(MapCase):
    def change(self, statement):
        with contextlib.closing(sqlite3.connect(self.map)) as database:
            database.execute(statement)
            database.commit()

    def start(self, *args):
        return subprocess.Popen([binaries['run'], 'run', self.data, '--map', self.map, '--verbose', *args],
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def long_drive(self):
        subprocess.run([binaries['sim'], 'street', '--out', self.data, '--seed', '7', '--frames', '250', '--force'],
                       check=True, capture_output=True)

    def wait_for_frames(self, process):
        for line in process.stderr:
            if 'stored: ' in line and 'stored: 0 ' not in line:
                return
        self.fail('nothing was stored')

    # Sessions
    def test_a_first_session_is_a_plain_run(self):
        self.assertEqual(self.run_data().returncode, 0)
        done = self.add('--out', self.out + '_map')
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in RUN_FILES:
            self.assertEqual(read(f'{self.out}/{name}'), read(f'{self.out}_map/{name}'), name)
        exported = call('map', 'export', self.map, '--out', self.out + '_export')
        self.assertEqual(exported.returncode, 0, exported.stderr)
        for name in ('map.json', 'map.ply', 'graph.g2o', 'loops.csv'):
            self.assertEqual(read(f'{self.out}/{name}'), read(f'{self.out}_export/{name}'), name)
        for name in ('trajectory_tum.txt', 'trajectory_kitti.txt', 'odometry_tum.txt', 'odometry_kitti.txt'):
            self.assertEqual(read(f'{self.out}/{name}'), read(f'{self.out}_export/data/{name}'), name)
        shown = json.loads(call('map', 'export', self.map, '--out', self.out + '_export', '--json').stdout)
        self.assertEqual([each['path'] for each in shown['written']], [line[len('wrote '):] for line in exported.stdout.splitlines()])
        self.assertTrue(all(each['bytes'] == os.path.getsize(each['path']) for each in shown['written']))
        geo = call('map', 'export', self.map, '--out', self.out + '_geo', '--origin', '49,8.4', '--heading', '90')
        self.assertEqual(geo.returncode, 0, geo.stderr)
        lines = json.loads(read(self.out + '_geo/map.geojson'))['features']
        self.assertEqual(lines[0]['geometry']['coordinates'][0], [8.4, 49.0])
        self.assertEqual(call('map', 'export', self.map, '--out', self.out, '--origin', '91,0').returncode, 2)
        self.assertFalse(os.path.exists('runs'), 'no run folder that was not asked for')

    def test_a_second_session(self):
        self.copy()
        done = self.add('--session', 'second', '--out', self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("session 'second', 40 frames stored", done.stdout)
        self.assertEqual(len(read(self.out + '/trajectory_tum.txt').splitlines()), 40)
        info = self.info()
        self.assertEqual([s['name'] for s in info['sessions']], ['first', 'second'])
        self.assertEqual([s['frame_offset'] for s in info['sessions']], [0, 40])
        self.assertTrue(all(s['ended'] for s in info['sessions']))
        for session, other in zip(info['sessions'], ('second', 'first')):
            joined = info['sessions'][1]['loops_to_earlier_sessions'] > 0
            self.assertEqual(session['common_map_with'], [other] if joined else [])
        self.assertIn('--session second', info['sessions'][1]['command'])
        self.assertEqual(info['sessions'][1]['dataset'], self.data)
        self.sound()
        self.assertIn('second', call('map', 'info', self.map).stdout)
        compacted = call('map', 'compact', self.map)
        self.assertEqual(compacted.returncode, 0, compacted.stderr)
        self.assertEqual(self.info()['sessions'], info['sessions'])

    def test_maps_are_merged(self):
        """The result is the map to which the second drive was added as a session."""
        self.copy()
        other, out = self.map + '.other', self.map + '.out'
        done = call('run', self.data, '--map', other, '--session', 'second', '--max-frames', '30')
        self.assertEqual(done.returncode, 0, done.stderr)
        def content():
            with open(self.map, 'rb') as file:
                return file.read()
        before = content()
        merged = call('map', 'merge', self.map, other, '--out', out)
        self.assertEqual(merged.returncode, 0, merged.stderr)
        self.assertIn("added 'second' of " + other + ', 30 frames', merged.stdout)
        self.assertEqual(content(), before)
        self.assertEqual(self.add('--session', 'second', '--max-frames', '30').returncode, 0)
        for path, folder in ((self.map, self.out + '_a'), (out, self.out + '_b')):
            self.assertEqual(call('map', 'export', path, '--out', folder).returncode, 0)
        for name in ('map.json', 'graph.g2o', 'loops.csv', 'second/trajectory_tum.txt'):
            self.assertEqual(read(f'{self.out}_a/{name}'), read(f'{self.out}_b/{name}'), name)
        self.refused(call('map', 'merge', self.map, other), 2, 'is the same drive as')
        self.refused(call('map', 'merge', self.map, self.map), 2, 'with itself')
        self.refused(call('map', 'merge', self.map, other, '--out', out), 2, 'exists')
        self.refused(call('map', 'merge', self.map, self.map + '.none'), 3, 'no such map')
        self.sound()

    def test_results_can_be_queried(self):
        with contextlib.closing(sqlite3.connect(f'file:{self.made}?mode=ro', uri=True)) as reader:
            self.assertEqual(reader.execute('SELECT count(*) FROM pose').fetchone(), (40,))
            seen = reader.execute("SELECT l.label, count(*) FROM landmark l JOIN sighting s ON s.landmark = l.id "
                                  "WHERE l.state = 'confirmed' GROUP BY l.label").fetchall()
            self.assertIn('Car', dict(seen))

    def test_wrong_requests(self):
        self.copy()
        self.refused(self.add('--session', 'first'), 2, "a session 'first' already", '--session')
        self.refused(self.add('--session', 'a/b'), 2, 'cannot be the name')
        self.refused(self.add('--session', 'x', '--set', 'window.keyframes=5'), 2, 'other options', 'keyframes: 5')
        self.refused(self.add('--session', 'x', '--mode', 'paper'), 2, 'other options')
        self.refused(self.add('--session', 'x', '--resume'), 2, 'no session to go on with')
        self.refused(call('run', self.data, '--session', 'x'), 2, '--map')
        self.refused(call('run', self.data, '--resume'), 2, '--map')
        self.refused(call('map', 'export', self.map), 2, '--out')
        self.assertEqual(len(self.info()['sessions']), 1)

    def test_options_of_the_map_are_kept(self):
        self.assertEqual(self.add('--set', 'window.keyframes=5').returncode, 0)
        done = self.add('--session', 'second', '--out', self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('keyframes: 5', read(self.out + '/config.yaml'))
        self.assertEqual(self.add('--session', 'third', '--set', 'window.keyframes=5').returncode, 0)

    def test_another_site(self):
        self.copy()
        yaml = read(self.data + '/sequence.yaml')
        write(self.data + '/sequence.yaml', yaml.replace('up_axis: [0, -1, 0]', 'up_axis: [0, 0, 1]'))
        self.assertNotEqual(read(self.data + '/sequence.yaml'), yaml)
        self.refused(self.add('--session', 'x'), 3, 'another site', 'up is (0 -1 0) there')
        write(self.data + '/sequence.yaml', yaml.replace('full', 'pi'))
        self.refused(self.add('--session', 'x'), 3, 'another site', "symmetry 'full' there")

    # Interruptions
    def test_signals_leave_a_session_that_goes_on(self):
        self.long_drive()
        for number in (signal.SIGTERM, signal.SIGINT):
            process = self.start(*(['--resume'] if os.path.exists(self.map) else []))
            self.wait_for_frames(process)
            process.send_signal(number)
            stderr = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 128 + number, stderr)
            self.assertIn('--resume goes on', stderr)
            self.assertFalse(self.info()['sessions'][0]['ended'])
            self.sound()
        self.refused(self.add(), 2, 'has not been ended', '--resume', 'map end')
        self.refused(self.add('--resume', '--session', 'other'), 2, "is 'data', not 'other'")
        frames = self.info()['sessions'][0]['frames']
        ended = call('map', 'end', self.map)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn(f"'data' ended with {frames} frames", ended.stdout)
        self.assertTrue(self.info()['sessions'][0]['ended'])

    def test_a_killed_session_goes_on(self):
        self.long_drive()
        test = KillTest(binaries['run'], self.data, os.path.dirname(self.data))
        test.run(3, 1)
        self.assertEqual(test.kills, 3)

    def test_a_changed_drive_does_not_go_on(self):
        self.long_drive()
        process = self.start()
        self.wait_for_frames(process)
        process.kill()
        process.communicate()
        self.edit_field('odometry.txt', 3, 1, '1.5')
        self.refused(self.add('--resume'), 3, "frame 3 is not the one that session 'data' was begun with", 'map end')
        self.sound()

    # Two processes
    def test_a_second_writer_is_told_who_writes(self):
        self.copy()
        write(self.map + '-lock', 'process 1 on somewhere since yesterday')
        with open(self.map + '-lock', 'r+') as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            for refused in (self.add('--session', 'x'), call('map', 'compact', self.map)):
                self.refused(refused, 1, 'being written by process 1 on somewhere since yesterday')
            self.sound()
            self.assertEqual(len(self.info()['sessions']), 1)
        self.assertEqual(self.add('--session', 'x').returncode, 0, 'a lock ends with its holder')
        self.assertFalse(os.path.exists(self.map + '-lock'))

    def test_readers_beside_a_writer(self):
        self.long_drive()
        process = self.start()
        self.wait_for_frames(process)
        frames = []
        while process.poll() is None and len(frames) < 20:
            self.sound()
            frames.append(self.info()['sessions'][0]['frames'])
            time.sleep(0.02)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(frames, sorted(frames))
        self.assertEqual(self.info()['sessions'][0]['frames'], 250)

    # Files that are no map, and disks
    def test_each_bad_file_has_its_own_message(self):
        def refused(code, *messages):
            self.refused(self.add('--session', 'x'), code, *messages)
            self.refused(call('map', 'verify', self.map), code, *messages)
        self.refused(call('map', 'info', self.map), 3, 'no such map')
        write(self.map, 'no database, but a text\n' * 100)
        refused(3, 'not an SQLite file')
        os.remove(self.map)
        self.change('CREATE TABLE t (a)')
        refused(3, 'database of another program')
        self.copy()
        self.change('PRAGMA user_version = 77')
        refused(3, 'schema 77', 'up to 1')
        self.copy()
        os.truncate(self.map, os.path.getsize(self.map) // 2)
        refused(3, 'is cut short')
        self.copy()
        self.change('UPDATE pose SET y = y + 1e-9 WHERE frame = 5')
        refused(3, 'is damaged', 'table pose')
        os.remove(self.map)
        os.mkdir(self.map)
        refused(3, 'is a folder')

    def test_a_flipped_bit_in_the_inputs(self):
        self.copy()
        with open(self.map, 'rb') as file:
            content = bytearray(file.read())
        with contextlib.closing(sqlite3.connect(self.map)) as reader:
            frame = reader.execute('SELECT content FROM input WHERE id = 20').fetchone()[0]
        place = content.find(frame[:200])
        self.assertGreater(place, 0)
        content[place + 100] ^= 4
        with open(self.map, 'wb') as file:
            file.write(content)
        self.refused(call('map', 'verify', self.map), 3, "session 'first' does not have its checksum")
        self.refused(self.add('--session', 'x'), 3, "session 'first' does not have its checksum")

    def test_read_only(self):
        folder = os.path.dirname(self.data)
        self.copy()
        os.chmod(self.root, 0o755)
        os.chmod(folder, 0o755)
        rights = {'preexec_fn': lambda: os.setuid(65534)} if os.geteuid() == 0 else {}
        if os.geteuid() != 0:
            os.chmod(folder, 0o555)
        try:
            self.refused(self.add('--session', 'x', **rights), 1, 'site.db-lock: cannot be made', 'folder')
            self.assertEqual(call('map', 'verify', self.map, **rights).returncode, 0, 'readers need no rights')
            os.chmod(folder, 0o777)
            os.chmod(self.map, 0o444)
            self.refused(self.add('--session', 'x', **rights), 1, 'the file is read-only')
        finally:
            os.chmod(folder, 0o755)

    @unittest.skipUnless(os.geteuid() == 0, 'needs a small disk')
    def test_a_full_disk(self):
        self.long_drive()
        disk = os.path.dirname(self.data) + '/disk'
        os.mkdir(disk)
        if subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=400k', 'none', disk], check=False).returncode:
            self.skipTest('no tmpfs')
        try:
            self.map = disk + '/site.db'
            self.refused(self.add(), 1, 'full', 'make room')
            self.sound()
            frames = self.info()['sessions'][0]['frames']
            self.assertGreater(frames, 0)
            subprocess.run(['mount', '-o', 'remount,size=20m', disk], check=True)
            done = self.add('--resume')
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.info()['sessions'][0]['frames'], 250)
        finally:
            subprocess.run(['umount', disk], check=True)


if __name__ == '__main__':
    main()
