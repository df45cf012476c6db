#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills (SIGKILL) `sslcd_run run DATASET --map` at random moments, and goes on each time until the session has ended.
    kill_map.py SSLCD_RUN DATASET KILLS [SEED]
After each kill the map has to be sound and to hold all frames that were reported as stored; in the end its export has
to be that of an uninterrupted run, byte by byte. Prints what it has done; exit code 1 if anything is wrong."""
import hashlib
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time


class Breach(Exception):
    """What must not happen."""


class KillTest:
    def __init__(self, binary, dataset, folder):
        self.binary, self.dataset, self.folder = binary, dataset, folder
        self.map = f'{folder}/killed.db'
        self.last_line = ''
        self.kills = self.ends = self.early = 0

    def call(self, *args):
        return subprocess.run([self.binary, *args], capture_output=True, text=True, check=False, timeout=600)

    def export(self, path):
        """A hash over the names and contents of all files."""
        out = path + '.export'
        done = self.call('map', 'export', path, '--out', out)
        if done.returncode:
            raise Breach(f'export: {done.stderr}')
        found = hashlib.sha256()
        for root, folders, names in os.walk(out):
            folders.sort()
            for name in sorted(names):
                with open(f'{root}/{name}', 'rb') as file:
                    found.update(name.encode() + file.read())
        return found.hexdigest()

    def reference(self):
        path, begin = f'{self.folder}/whole.db', time.monotonic()
        done = self.call('run', self.dataset, '--map', path, '--quiet')
        if done.returncode:
            raise Breach(done.stderr)
        return self.export(path), time.monotonic() - begin

    def session(self):
        """What the map tells of its session; None: there is none yet."""
        told = self.call('map', 'info', self.map, '--json')
        if told.returncode:
            if self.call('map', 'verify', self.map).returncode != 3 or not re.search(
                    'no such map|has no map', told.stderr):
                raise Breach(f'neither a map nor none: {told.stderr}')
            return None
        sessions = json.loads(told.stdout)['sessions']
        return sessions[0] if sessions else None

    def run_for(self, seconds, resume):
        """Runs, and kills after so long. Returns the exit code and the frames reported as stored."""
        process = subprocess.Popen([self.binary, 'run', self.dataset, '--map', self.map, '--verbose',
                                    *(['--resume'] if resume else [])], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        reported, self.last_line = [0], ''

        def read():
            for line in process.stderr:
                self.last_line = line
                stored = re.search(r'stored: (\d+) frames', line)
                if stored:
                    reported[0] = int(stored.group(1))
        reader = threading.Thread(target=read)
        reader.start()
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
        reader.join()
        process.stderr.close()
        return process.returncode, reported[0]

    def check(self, code, reported):
        if code not in (0, -signal.SIGKILL):
            raise Breach(f'exit code {code}: {self.last_line}')
        session = self.session()
        if session is None:
            if reported:
                raise Breach(f'{reported} frames were reported as stored, but there is no session')
            self.early += 1
            return
        verified = self.call('map', 'verify', self.map)
        if verified.returncode:
            raise Breach(f'verify: {verified.stderr}')
        if session['frames'] < reported:
            raise Breach(f"{reported} frames were reported as stored, {session['frames']} are there")

    def run(self, kills, seed):
        chance = random.Random(seed)
        whole, seconds = self.reference()
        while self.kills < kills:
            session = self.session()
            if session and session['ended']:
                self.ends += 1
                if self.export(self.map) != whole:
                    raise Breach('the export differs from that of an uninterrupted run')
                for ending in ('', '-wal', '-shm', '-lock'):
                    if os.path.exists(self.map + ending):
                        os.remove(self.map + ending)
                session = None
            code, reported = self.run_for(chance.uniform(0, seconds), session is not None)
            self.kills += code == -signal.SIGKILL
            self.check(code, reported)
        session, code = self.session(), 0
        if not (session and session['ended']):  # the last kill may have come after the end
            code, reported = self.run_for(600, session is not None)
            self.check(code, reported)
        if code or self.export(self.map) != whole:
            raise Breach('the last session has not ended as an uninterrupted run')
        self.ends += 1


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory(prefix='sslcd_kill_') as folder:
        test = KillTest(sys.argv[1], sys.argv[2], folder)
        try:
            test.run(int(sys.argv[3]), int(sys.argv[4]) if len(sys.argv) > 4 else 1)
        except Breach as breach:
            sys.exit(f'after {test.kills} kills: {breach}')
        print(f'{test.kills} kills, {test.early} of them before the session had begun; {test.ends} sessions ended, '
              'all as an uninterrupted run')


if __name__ == '__main__':
    main()
