#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs sslcd_run on inputs of which one file was damaged at random, and checks what it does (docs/trust.md).
    scripts/mutated_inputs.py [--inputs N] [--seed S] [--only run,graph] [--keep FOLDER] [--verbose]
    --run FILE       sslcd_run (default: apps/sslcd_run in SSLCD_BUILD_DIR or build/release)
For each input: no signal, no more than --seconds of time; exit code 0, or an error that names a file or a key; the
inputs are what they were; an error leaves no output and no temporary file. Prints a table: how many inputs were refused,
how many were used with a warning, without one, and without one though the output differs from that of the sound input.
Exit code 1 if anything is violated; --keep keeps such inputs."""
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

RUN = 'run data --max-frames 40 --out {} --quiet'


@dataclasses.dataclass
class Command:
    name: str
    words: str
    inputs: str  # regular expression of the files that are damaged, one at a time
    before: tuple = ()  # commands that make the inputs
    writes: str = ''  # an input that the command may change: a map


ALL = [
    Command('run', RUN.format('out') + ' --groundtruth data/groundtruth.txt', r'data/.*'),
    Command('run --config', RUN.format('out') + ' --config run/config.yaml', r'run/config\.yaml', (RUN.format('run'),)),
    Command('run --map', RUN.format('out') + ' --map site.db --session two', r'site\.db', (RUN.format('run --map site.db'),), 'site.db'),
    Command('map verify', 'map verify site.db', r'site\.db', (RUN.format('run --map site.db'),)),
    Command('map export', 'map export site.db --out out -q', r'site\.db', (RUN.format('run --map site.db'),)),
    Command('relocalise', 'relocalise data --map site.db --frames 15 --out out -q', r'site\.db|data/.*', (RUN.format('run --map site.db'),)),
    Command('check', 'check data', r'data/.*'),
    Command('check --fix', 'check wrong --fix out -q', r'wrong/.*'),
    Command('eval', 'eval run --groundtruth data/groundtruth.txt', r'run/.*|data/groundtruth\.txt', (RUN.format('run'),)),
    Command('report', 'report run --out out', r'run/.*', (RUN.format('run'),)),
    Command('export', 'export run --out out.glb', r'run/.*', (RUN.format('run'),)),
    Command('draw', 'draw run --out out.svg', r'run/.*', (RUN.format('run'),)),
    Command('match', 'match pairs.txt --out out -q', r'pairs\.txt'),
    Command('graph', 'graph loops.g2o --out out --robust -q', r'loops\.g2o'),
    Command('detect', 'detect stereo --boxes stereo/boxes.txt --out out --no-check --threads 1', r'stereo/.*'),
    Command('sites', 'sites find data --sites all.sites', r'all\.sites',
            (RUN.format('run --map site.db'), 'sites index site.db --out all.sites')),
]
TOKENS = [b'nan', b'-inf', b'1e309', b'-1', b'0', b'', b'99999999999999999999', b'1e-320', b'2147483648', b'"', b'\0', b'\xff\xfe', b'{', b'[',
          b': ', b',', b'#', b'\r\n', b'  ', b'../../etc/passwd', b'&a', b'*a', b'<a>', b'0x10', b'1,5', b'\xc2\xa0', b'true', b'~']


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
                 lambda: splice(data, a, a, dice.choice(TOKENS)), lambda: splice(data, a, a + 1, bytes([dice.randrange(256)])),
                 lambda: splice(data, a, a + 4, dice.choice([b'\xff\xff\xff\x7f', b'\0\0\0\0', b'\xff\xff\xff\xff', b'\0\0\0\x80'])),
                 lambda: b'' if dice.random() < 0.1 else data]
        if numbers and b'\0' not in data:
            edits += 4 * [lambda: splice(data, *dice.choice(numbers), dice.choice(TOKENS))]
        if len(lines) > 1 and b'\0' not in data:
            i, k = dice.randrange(len(lines)), dice.randrange(len(lines))
            edits += [lambda: b''.join(lines[:i] + lines[i + 1:]), lambda: b''.join(lines[:i] + [lines[k]] + lines[i:])]
        data = dice.choice(edits)()
    return data


def content(folder, but=()):
    """Hash of each file below a folder, by its name."""
    hashes = {}
    for place, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(place, name)
            short = os.path.relpath(path, folder)
            if short.split('/')[0] not in but:
                with open(path, 'rb') as file:
                    hashes[short] = hashlib.sha256(file.read()).hexdigest()
    return hashes


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
        self.keep = {name: open(f'{folder}/{name}', 'rb').read() for name in self.sound}
        done = self.call(command.words)
        if done.returncode not in (0, 5):  # 5: no answer
            sys.exit(f'{command.name}: {done.stderr}')
        self.code, self.wanted = done.returncode, self.results(done)
        self.clean()

    def call(self, words):
        return subprocess.run([self.binary, *words.split()], cwd=self.folder, capture_output=True, text=True, errors='replace',
                              timeout=self.seconds)

    def results(self, done):
        made = {name: hash for name, hash in content(self.folder).items() if name not in self.sound}
        return {name: hash for name, hash in made.items() if not re.search(r'run\.json|timing|\.html|-wal|-shm', name)} or done.stdout

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
        """(what happened, violations, file, its bytes, what was said)"""
        name = dice.choice(self.names)
        data = mutate(self.keep[name], dice)
        with open(f'{self.folder}/{name}', 'wb') as file:
            file.write(data)
        before = content(self.folder)
        try:
            done = self.call(self.command.words)
        except subprocess.TimeoutExpired:
            self.clean()
            return 'too slow', [f'takes more than {self.seconds} s'], name, data, ''
        after, violations = content(self.folder), []
        code, said = done.returncode, done.stderr + (done.stdout if self.command.words.startswith(('check', 'map verify')) else '')
        if code < 0 or code > 6:
            violations.append(f'ends with {code}')
        changed = [n for n in before if after.get(n) != before[n] and n != self.command.writes]
        violations += [f'changes {n}' for n in changed]
        left = [n for n in after if n not in before and (code != 0 or '.tmp' in n) and not n.endswith(('.db-wal', '.db-shm'))]
        violations += [f'leaves {n}' for n in left]
        if code not in (0, self.code) and not any(word in said for word in {name, os.path.basename(name), os.path.dirname(name) or name}):
            violations.append('does not name the file: ' + said.strip()[:200])
        same = self.results(done) == self.wanted
        happened = ('refused' if code not in (0, self.code) else 'with a warning' if re.search(r'warn', said, re.I) else 'no difference' if same else 'other results')
        self.clean()
        return happened, violations, name, data, said.strip()


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
    chosen = [c for c in ALL if not options.only or c.name in options.only.split(',')]
    kinds = ['refused', 'with a warning', 'no difference', 'other results', 'too slow']
    dice, total, bad = random.Random(options.seed), collections.Counter(), 0
    print(f'{"inputs":14}', *(f'{kind:>15}' for kind in [*kinds, 'violations']))
    for command in chosen:
        counts = collections.Counter()
        memory = '/dev/shm' if os.access('/dev/shm', os.W_OK) else None
        with tempfile.TemporaryDirectory(prefix='sslcd_mutated_', dir=memory) as folder:
            bench = Bench(os.path.abspath(options.run), command, folder, options.seconds)
            for number in range(-(-options.inputs // len(chosen))):
                happened, violations, name, data, said = bench.trial(dice)
                counts[happened] += 1
                counts['violations'] += len(violations)
                if options.verbose or violations:
                    print(f'  {command.name} {number} {name}: {happened}: {"; ".join(violations)} | {said[:300]}', flush=True)
                if violations and options.keep:
                    os.makedirs(options.keep, exist_ok=True)
                    with open(f'{options.keep}/{command.name} {number} {name.replace("/", " ")}'.replace(' ', '_'), 'wb') as file:
                        file.write(data)
        print(f'{command.name:14}', *(f'{counts[kind] or "":>15}' for kind in [*kinds, 'violations']), flush=True)
        total += counts
    print(f'{"all":14}', *(f'{total[kind] or "":>15}' for kind in [*kinds, 'violations']))
    sys.exit(1 if total['violations'] else 0)


if __name__ == '__main__':
    main()
