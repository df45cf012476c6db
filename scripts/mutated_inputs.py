#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs sslcd_run on inputs of which one file was damaged at random, and checks what it does (docs/trust.md).
    scripts/mutated_inputs.py [--inputs N] [--seed S] [--only run,graph] [--keep FOLDER] [--verbose]
    --run FILE       sslcd_run (default: apps/sslcd_run in SSLCD_BUILD_DIR or build/release)
For each input: no signal, no report of a sanitizer, no more than --seconds of time; exit code 0, or one for bad input
and an error that names the file, or another one in its folder; the inputs are what they were; an error leaves no file
in the output and no temporary file. Prints a table: how many inputs were refused, how many were used with a warning
that the sound input does not give, without one, and without one though the output differs from that of the sound input;
and how often an error left an empty folder. Exit code 1 if anything is violated; --keep keeps such inputs."""
import argparse
import collections
import dataclasses
import hashlib
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..')
sys.path.insert(0, os.path.join(ROOT, 'tests/faults'))
from fault_commands import write_inputs  # noqa: E402

RUN = 'run data --max-frames 40 --out {}'
A_RUN, A_MAP = (RUN.format('run'),), (RUN.format('run --map site.db'),)
CODES = (0, 2, 3, 4, 5, 6)  # docs/formats.md; 1, a result that could not be written, says nothing of the input
COLUMNS = ['refused', 'with a warning', 'no difference', 'other results', 'too slow', 'empty folder', 'violations']


@dataclasses.dataclass
class Command:
    name: str
    words: str
    inputs: str  # regular expression of the files that are damaged, one at a time
    before: tuple = ()  # commands that make the inputs
    writes: str = ''  # an input that the command may change: a map
    answers: tuple = (0,)  # exit codes with a result; 5: not found


ALL = [
    Command('run', RUN.format('out') + ' --groundtruth data/groundtruth.txt', r'data/.*'),
    Command('run --config', RUN.format('out') + ' --config run/config.yaml', r'run/config\.yaml', A_RUN),
    Command('run --map', RUN.format('out') + ' --map site.db --session two', r'site\.db', A_MAP, 'site.db'),
    Command('map verify', 'map verify site.db', r'site\.db', A_MAP),
    Command('map export', 'map export site.db --out out', r'site\.db', A_MAP),
    Command('relocalise', 'relocalise data --map site.db --frames 15 --out out', r'site\.db|data/.*', A_MAP,
            answers=(0, 5)),
    Command('check', 'check data', r'data/.*'),
    Command('check --fix', 'check wrong --fix out', r'wrong/.*'),
    Command('eval', 'eval run --groundtruth data/groundtruth.txt', r'run/.*|data/groundtruth\.txt', A_RUN),
    Command('report', 'report run --out out', r'run/.*', A_RUN),
    Command('export', 'export run --out out.glb', r'run/.*', A_RUN),
    Command('draw', 'draw run --out out.svg', r'run/.*', A_RUN),
    Command('match', 'match pairs.txt --out out', r'pairs\.txt'),
    Command('graph', 'graph loops.g2o --out out --robust', r'loops\.g2o'),
    Command('detect', 'detect stereo --boxes stereo/boxes.txt --out out --no-check --threads 1', r'stereo/.*'),
    Command('sites', 'sites find data --sites all.sites', r'all\.sites',
            (*A_MAP, 'sites index site.db --out all.sites')),
]
TOKENS = [b'nan', b'-inf', b'1e309', b'-1', b'0', b'', b'99999999999999999999', b'1e-320', b'2147483648', b'"', b'\0',
          b'\xff\xfe', b'{', b'[', b': ', b',', b'#', b'\r\n', b'  ', b'../../etc/passwd', b'&a', b'*a', b'<a>',
          b'0x10', b'1,5', b'\xc2\xa0', b'true', b'~']
INTEGERS = [b'\xff\xff\xff\x7f', b'\0\0\0\0', b'\xff\xff\xff\xff', b'\0\0\0\x80']


def splice(data, begin, end, new):
    return data[:begin] + new + data[end:]


def mutate(data, dice):
    """One to three edits of bytes, of numbers, or of lines."""
    for _ in range(dice.choice([1, 1, 1, 2, 3])):
        numbers = [m.span() for m in re.finditer(rb'[-+.\w]*\d[-+.\w]*', data[:200000])]
        lines = data.splitlines(keepends=True)
        a, b = sorted(dice.randrange(len(data) + 1) for _ in range(2))
        b = min(b, a + dice.choice([1, 8, 100, 10000]))
        edits = [lambda: data[:a], lambda: splice(data, a, b, b''), lambda: splice(data, a, a, data[a:b]),
                 lambda: splice(data, a, a, dice.choice(TOKENS)),
                 lambda: splice(data, a, a + 1, bytes([dice.randrange(256)])),
                 lambda: splice(data, a, a + 4, dice.choice(INTEGERS)),
                 lambda: b'' if dice.random() < 0.1 else data]
        if numbers and b'\0' not in data:
            edits += 4 * [lambda: splice(data, *dice.choice(numbers), dice.choice(TOKENS))]
        if len(lines) > 1 and b'\0' not in data:
            i, k = dice.randrange(len(lines)), dice.randrange(len(lines))
            edits += [lambda: b''.join(lines[:i] + lines[i + 1:]), lambda: b''.join(lines[:i] + [lines[k]] + lines[i:])]
        data = dice.choice(edits)()
    return data


def content(folder):
    """Hash of each file below a folder, by its name; an empty folder has a name with a slash at its end."""
    hashes = {}
    for place, folders, names in os.walk(folder):
        for name in names:
            path = os.path.join(place, name)
            with open(path, 'rb') as file:
                hashes[os.path.relpath(path, folder)] = hashlib.sha256(file.read()).hexdigest()
        if not folders and not names:
            hashes[os.path.relpath(place, folder) + '/'] = ''
    return hashes


@dataclasses.dataclass
class Trial:
    name: str  # of the damaged file
    data: bytes
    happened: str = 'too slow'
    said: str = ''
    violations: list = dataclasses.field(default_factory=list)
    empty_folder: bool = False  # left by an error


class Bench:
    """One command, with sound inputs in a folder of its own."""
    def __init__(self, binary, command, folder, seconds):
        self.binary, self.command, self.folder, self.seconds = binary, command, folder, seconds
        write_inputs(folder, command.words)
        for words in command.before:
            done = self.call(words)
            if done.returncode:
                sys.exit(f'{command.name}: {words}: {done.stderr}')
        if command.writes:
            shutil.rmtree(folder + '/run', ignore_errors=True)
        self.names = sorted(name for name in content(folder) if re.fullmatch(command.inputs, name))
        self.sound = content(folder)
        self.keep = {}
        for name in self.sound:
            with open(f'{folder}/{name}', 'rb') as file:
                self.keep[name] = file.read()
        done = self.call(command.words)
        if done.returncode not in (0, 5):  # 5: no answer
            sys.exit(f'{command.name}: {done.stderr}')
        self.code, self.wanted, self.warnings = done.returncode, self.results(done), warnings(self.said(done))
        self.clean()

    def call(self, words):
        return subprocess.run([self.binary, *words.split()], cwd=self.folder, capture_output=True, text=True,
                              errors='replace', timeout=self.seconds, check=False)

    def said(self, done):
        """Errors and warnings; those of the commands that check something are their output."""
        return done.stderr + (done.stdout if self.command.words.startswith(('check', 'map verify')) else '')

    def results(self, done):
        made = {name: hash for name, hash in content(self.folder).items() if name not in self.sound}
        times = re.compile(r'run\.json|timing|\.html|-wal|-shm')
        return {name: hash for name, hash in made.items() if not times.search(name)} or done.stdout

    def clean(self):
        for name in os.listdir(self.folder):
            if not any(one == name or one.startswith(name + '/') for one in self.sound):
                path = f'{self.folder}/{name}'
                shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)
        for name, data in self.keep.items():
            path = f'{self.folder}/{name}'
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, 'wb') as file:
                file.write(data)

    def trial(self, dice):
        """Damages a file, runs the command, and puts everything back."""
        name = dice.choice(self.names)
        data = self.keep[name]
        while data == self.keep[name]:
            data = mutate(data, dice)
        with open(f'{self.folder}/{name}', 'wb') as file:
            file.write(data)
        trial, before = Trial(name, data), content(self.folder)
        try:
            self.judge(trial, before, self.call(self.command.words))
        except subprocess.TimeoutExpired:
            trial.violations.append(f'takes more than {self.seconds} s')
        self.clean()
        return trial

    def judge(self, trial, before, done):
        """What has happened, and what may not."""
        after, name, code, said = content(self.folder), trial.name, done.returncode, self.said(done)
        refused = code not in (*self.command.answers, self.code)
        if code not in CODES:
            trial.violations.append(f'ends with {code}')
        if re.search('Sanitizer|runtime error:', done.stderr):
            trial.violations.append('a sanitizer reports')
        trial.violations += [f'changes {n}' for n in before if after.get(n) != before[n] and n != self.command.writes]
        left = [n for n in after if n not in before and (code not in self.command.answers or '.tmp' in n)]
        files = [n for n in left if not n.endswith(('.db-wal', '.db-shm', '/'))]
        trial.violations += [f'leaves {n}' for n in files]
        trial.empty_folder = any(n.endswith('/') for n in left)
        names = {name, os.path.basename(name)} | ({os.path.dirname(name) + '/'} if '/' in name else set())
        error = ''.join(done.stderr.partition('error:')[1:]) + said[len(done.stderr):]  # without the warnings before
        if refused and not any(one in error for one in names):
            trial.violations.append('does not name the file: ' + said.strip()[:200])
        same = self.results(done) == self.wanted
        trial.said = said.strip()
        trial.happened = ('refused' if refused else 'with a warning' if warnings(said) - self.warnings else
                          'no difference' if same else 'other results')


def warnings(said):
    return {line for line in said.splitlines() if re.search('warn', line, re.I)}


def chosen_commands(parser, options):
    known = {command.name: command for command in ALL}
    names = list(known) if options.only is None else options.only.split(',')
    unknown = [name for name in names if name not in known]
    if unknown:
        parser.error(f'no command {", ".join(map(repr, unknown))}; known are {", ".join(known)}')
    if options.inputs < 1:
        parser.error('--inputs: at least one')
    return [known[name] for name in names]


def run_trials(command, number, dice, options):
    """Counts of what happened with so many inputs; prints and keeps those that violate something."""
    counts = collections.Counter()
    memory = '/dev/shm' if os.access('/dev/shm', os.W_OK) else None
    with tempfile.TemporaryDirectory(prefix='sslcd_mutated_', dir=memory) as folder:
        bench = Bench(os.path.abspath(options.run), command, folder, options.seconds)
        for i in range(number):
            trial = bench.trial(dice)
            counts.update({trial.happened: 1, 'empty folder': trial.empty_folder, 'violations': len(trial.violations)})
            if options.verbose or trial.violations:
                print(f'  {command.name} {i} {trial.name}: {trial.happened}: {"; ".join(trial.violations)} | '
                      f'{trial.said[:300]}', flush=True)
            if trial.violations and options.keep:
                os.makedirs(options.keep, exist_ok=True)
                kept = re.sub('[ /]', '_', f'{command.name} {i} {trial.name}')
                with open(f'{options.keep}/{kept}', 'wb') as file:
                    file.write(trial.data)
    return counts


def print_row(name, cells):
    print(f'{name:14}', *(f'{cell or "":>15}' for cell in cells), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--inputs', type=int, default=3000)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--only')
    parser.add_argument('--seconds', type=float, default=10)
    parser.add_argument('--run', default=os.environ.get('SSLCD_BUILD_DIR', ROOT + '/build/release') + '/apps/sslcd_run')
    parser.add_argument('--keep')
    parser.add_argument('--verbose', action='store_true')
    options = parser.parse_args()
    chosen = chosen_commands(parser, options)
    dice, total = random.Random(options.seed), collections.Counter()
    print_row('inputs', COLUMNS)
    for command in chosen:
        counts = run_trials(command, -(-options.inputs // len(chosen)), dice, options)
        print_row(command.name, [counts[column] for column in COLUMNS])
        total += counts
    print_row('all', [total[column] for column in COLUMNS])
    sys.exit(1 if total['violations'] else 0)


if __name__ == '__main__':
    main()
