# SPDX-License-Identifier: BSD-3-Clause
"""One fault in one command of sslcd_run: what is left is checked, then the command is run again (scripts/fault_test.py)."""
import collections
import dataclasses
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess

from fault_commands import Command, write_inputs

HOLDS_TIMES = re.compile(r'run\.json|timing\.json|report\.html|out\.html|trials/.*\.json|commit\.txt')
BESIDE_A_MAP = re.compile(r'out\.db-(wal|shm|journal|lock)')
TEMPORARY = re.compile(r'\.tmp-\d+$|\.sslcd-(lock|unfinished-\w+)$')
MARK = re.compile(r'/\.sslcd-unfinished-\w+$')  # a folder may have files of two calls
ALONE = re.compile(r'/overlays/|/trials/|/baselines.yaml$')  # files that belong to no set
TOLD_BY_DETECT = r'image_\d/\d+\.png: no image that can be read|holds the frames before it'
ERROR_CODES = (1, 3)  # a result could not be written, an input could not be read
NO_SOLUTION = (5,)  # the solver has told that it had no memory


@dataclasses.dataclass
class State:
    """What a command finds, and what it makes of it without faults: contents of files by name."""
    binary: str
    shim: str
    command: Command
    template: str  # copied to `folder` before each trial
    folder: str
    old: dict
    new: dict
    counts: dict  # kind of call -> how many
    clean_names: set = dataclasses.field(default_factory=set)  # of all files after a clean run

    def call(self, words, fault=None, log=None):
        environment = dict(os.environ)
        if fault or log:
            environment.update(LD_PRELOAD=self.shim, FAULT_UNDER=self.folder, FAULT_SIZE='1', FAULT_LOG=log,
                               FAULT_AT=':'.join(map(str, fault or ('alloc', 0, 'NULL'))))
        return subprocess.run([self.binary, *words.split()], cwd=self.folder, env=environment, text=True, capture_output=True,
                              errors='replace', timeout=120, check=False)

    def reset(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.template, self.folder)

    def results(self):
        """Contents of what the command writes, by name; of a map, those of its export."""
        if not self.command.out.endswith('.db'):
            return files(self.folder, self.command.out)
        shutil.rmtree(self.folder + '.export', ignore_errors=True)
        if os.path.exists(self.folder + '/' + self.command.out):
            self.call(f'map export {self.command.out} --out {self.folder}.export')
        return files(self.folder + '.export', '')

    def names(self):
        """Of all files in the folder."""
        return set(files(self.folder, ''))


def files(folder, below):
    top, found = os.path.join(folder, below), {}
    if os.path.isfile(top):
        top, found = folder, {below: None}
    for path in found or [os.path.join(root, name) for root, _, names in os.walk(top) for name in names]:
        with open(os.path.join(folder, path), 'rb') as file:
            content = file.read()
        if path.endswith('out.csv'):  # the last column of match is a time
            content = re.sub(rb',[0-9.]+\n', b',\n', content)
        found[os.path.relpath(os.path.join(folder, path), folder)] = content
    return found


def prepare(binary, shim, command, folder):
    """Makes what is there before, and runs the command twice without a fault: what it writes and calls."""
    name = folder + '/' + re.sub(r'\W+', '_', command.name)
    state = State(binary, shim, command, name + '.template', name, {}, {}, {})
    write_inputs(name, command.words)
    for words in command.before:
        kill = re.match(r'KILL (\w+):(\d+) (.*)', words)
        done = state.call(kill[3], (kill[1], kill[2], 'before'), '/dev/null') if kill else state.call(words)
        assert done.returncode == (-signal.SIGKILL if kill else 0), (words, done.returncode, done.stderr)
    shutil.copytree(state.folder, state.template)
    state.old = state.results()
    log, runs = name + '.log', []
    for _ in range(2):
        state.reset()
        done = state.call(command.words, log=log)
        assert done.returncode == 0, (command.words, done.returncode, done.stderr)
        runs.append((state.results(), state.names()))
    state.new, state.clean_names = runs[1]
    assert runs[0][1] == runs[1][1], f'{command.name}: names differ between two runs'
    for path, content in state.new.items():
        assert content == runs[0][0][path] or HOLDS_TIMES.search(path), f'{command.name}: {path} differs between two runs'
    with open(log) as file:
        lines = file.read().splitlines()
    last_run = lines[len(lines) // 2:]
    counts = collections.Counter(line.split()[0] for line in last_run)
    state.counts = {**counts, 'any': sum(counts.values()) - counts['allocations'], 'alloc': int(last_run[-1].split()[1])}
    return state


class Trial:
    def __init__(self, state, fault):
        self.state, self.fault, self.command = state, fault, state.command
        self.violations, self.reached, self.warned, self.ending, self.message = [], False, False, '', ''

    def run(self):
        state, log = self.state, self.state.folder + '.log'
        state.reset()
        open(log, 'w').close()
        try:
            done = state.call(self.command.words, self.fault, log)
        except subprocess.TimeoutExpired:
            self.violations.append('hangs')
            return
        with open(log) as file:
            self.reached = any(line.startswith('fault ') for line in file)
        self.message = done.stderr.strip().splitlines()[-1] if done.stderr.strip() else ''
        self.check_ending(done)
        # detect leaves out an image that it cannot read, or keeps the frames before an error, and says so
        self.warned = self.command.name.startswith('detect') and re.search(TOLD_BY_DETECT, done.stderr)
        self.check_files(done.returncode)
        if self.command.out.endswith('.db'):
            self.check_map()
        elif os.path.exists(state.folder + '/out/run.json'):
            self.check_mix()
        elif not self.warned and 'out/run.json' not in state.new:
            self.check_set()
        self.run_again()

    def expect(self, holds, text):
        if not holds:
            self.violations.append(text)

    def check_ending(self, done):
        kind, _, what = self.fault
        code = done.returncode
        self.ending = {0: 'as without a fault', -signal.SIGKILL: 'killed'}.get(code, f'error, exit code {code}')
        if not self.reached:
            self.ending = 'not reached'
        if what in ('before', 'after') and self.reached:
            self.expect(code == -signal.SIGKILL, f'exit code {code} instead of the signal')
        elif what == 'short' or what == 'EINTR' and kind in ('write', 'read'):
            self.expect(code == 0, f'exit code {code}: the rest of the bytes was not asked for: {done.stderr}')
        elif code != 0:
            self.expect(code in (*ERROR_CODES, *(NO_SOLUTION if kind == 'alloc' else ())), f'exit code {code}: {done.stderr}')
            told = re.search('error: .*', done.stderr)
            named = 'memory|bad_alloc' if kind == 'alloc' else r'\b(out|data|wrong|stereo|site|pairs|loops|run)\b|' + self.state.folder
            self.expect(told and (re.search(named, told[0]) or code in NO_SOLUTION), f'the message names no file: {done.stderr}')

    def check_files(self, code):
        """Each file under a final name is old or new; all are new if the program says so."""
        state, is_map = self.state, self.command.out.endswith('.db')
        now = files(state.folder, '' if is_map else self.command.out)
        known = state.clean_names
        for path, content in now.items():
            if TEMPORARY.search(path):
                stays = code in (-signal.SIGKILL, 0) or self.fault[0] == 'unlink' or MARK.search(path)
                self.expect(stays, f'{path} is left after an error')
            elif is_map:
                self.expect(path in known or BESIDE_A_MAP.fullmatch(path), f'{path} is no file of a map')
            elif not self.warned and content not in (state.old.get(path), state.new.get(path)):
                self.expect(HOLDS_TIMES.search(path) and is_whole(path, content), f'{path} is neither the old nor the new one')
        if code == 0 and not self.warned:
            self.check_new('exit code 0, but')

    def check_new(self, when):
        now = {path: content for path, content in self.state.results().items() if not TEMPORARY.search(path)}
        for path, content in self.state.new.items():
            if HOLDS_TIMES.search(path) and path in now:
                self.expect(is_whole(path, now[path]), f'{when} {path} is not whole')
            else:
                self.expect(now.get(path) == content, f'{when} {path} is not that of a clean run')
        self.expect(set(now) <= set(self.state.new), f'{when} there are also {sorted(set(now) - set(self.state.new))}')

    def check_mix(self):
        """A folder with files of two runs is refused."""
        now = files(self.state.folder, 'out')
        try:
            listed = json.loads(now['out/run.json'])['files']
        except ValueError:
            return  # told by check_files
        wrong = [file['name'] for file in listed
                 if hashlib.sha256(now.get('out/' + file['name'], b'')).hexdigest() != file['sha256']]
        told = self.state.call('eval out --groundtruth data/groundtruth.txt')
        if wrong:
            self.expect(told.returncode == 3 and 'out/' in told.stderr, f'eval takes files of two runs: {wrong}')
        else:
            self.expect(told.returncode == 0, f'eval refuses a whole run: {told.stderr}')

    def check_set(self):
        """A folder with files of two calls has a mark, and one with a mark is refused."""
        state, now = self.state, self.state.results()
        names = [name for name in {**state.old, **state.new} if not (ALONE.search(name) or HOLDS_TIMES.search(name))]
        is_old, is_new = (all(now.get(name) == made.get(name) for name in names) for made in (state.old, state.new))
        mark = any(map(MARK.search, now))
        self.expect(is_old or is_new or mark, 'files of two calls without a mark')
        if mark and re.match('detect|check', self.command.name):
            told = state.call('check out')
            self.expect(told.returncode == 3 and 'two calls' in told.stderr, f'check takes files of two calls: {told.stderr}')

    def check_map(self):
        told = self.state.call('map verify ' + self.command.out)
        none = told.returncode == 3 and re.search('no such map|has no map', told.stderr)
        self.expect(told.returncode == 0 or none and not self.state.old, f'map verify: {told.stderr}')

    def run_again(self):
        """Without a fault. A map's session is gone on with, if it has begun and has not ended."""
        words = self.command.words
        if self.command.out.endswith('.db'):
            told = self.state.call(f'map info {self.command.out} --json')
            sessions = json.loads(told.stdout)['sessions'] if told.returncode == 0 else []
            name = re.search(r'--session (\S+)', words)
            mine = [session for session in sessions if not name or session['name'] == name[1]]
            if mine and words.startswith('run') or words.startswith('map end'):
                words = words.replace(' --resume', '') + ' --resume' if words.startswith('run') else words
                words = '' if mine and mine[0]['ended'] else words
            elif words.startswith('run'):
                words = words.replace(' --resume', '')
        if not self.command.replaces:
            shutil.rmtree(self.state.folder + '/' + self.command.out, ignore_errors=True)
        done = self.state.call(words) if words else None
        if done and done.returncode != 0:
            self.violations.append(f'cannot be run again: {done.stderr}')
            return
        self.check_new('when run again,')
        left = {name for name in self.state.names() - self.state.clean_names if words or not BESIDE_A_MAP.fullmatch(name)}
        self.expect(not left, f'left when run again: {sorted(left)}')


def is_whole(path, content):
    if not path.endswith('.json'):
        return not path.endswith('.html') or content.rstrip().endswith(b'</html>')
    try:
        json.loads(content)
        return True
    except ValueError:
        return False
