#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes system calls and allocations of sslcd_run fail, one in each trial, and checks what is left.
    scripts/fault_test.py [--faults N] [--seed S] [--only run,graph] [--verbose]
    --run FILE       sslcd_run (default: apps/sslcd_run in SSLCD_BUILD_DIR or build/release)
    --shim FILE      compiled from tests/faults/shim.c (default: compiled with cc)
Of all calls of each command, a sample is drawn that has each kind of call and of fault (docs/trust.md). After
each fault: exit code 0 with the results of a clean run, or an error that names a file, or killed by the test; each
file under a final name is that of the old or of the new run; a folder with files of both is refused; a map is sound.
Then the command has to work, with the results of a clean run, and no temporary file may be left. Prints a table;
exit code 1 if anything is violated."""
import argparse
import collections
import os
import random
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..')
sys.path.insert(0, os.path.join(ROOT, 'tests/faults'))
from fault_commands import commands  # noqa: E402
from fault_trial import Trial, prepare  # noqa: E402

FAULTS = {'open': ['EIO', 'ENOSPC', 'EINTR'], 'write': ['EIO', 'ENOSPC', 'EINTR', 'short'], 'read': ['EIO', 'EINTR', 'short'],
          'rename': ['EIO'], 'sync': ['EIO', 'EINTR'], 'close': ['EIO', 'EINTR'], 'mkdir': ['EIO', 'ENOSPC'],
          'truncate': ['EIO', 'ENOSPC', 'EINTR'], 'unlink': ['EIO'], 'any': ['before', 'after'], 'alloc': ['NULL']}


def sample(counts, wanted, dice):
    """Up to `wanted` faults (kind, number of the call, what): all kinds in turn, each at calls that are spread evenly."""
    groups = []
    for kind, whats in FAULTS.items():
        for what in whats:
            count = counts.get(kind, 0)
            numbers = list(range(1, count + 1))
            take = min(count, wanted)
            start = dice.random()
            spread = sorted({numbers[int((i + start) * count / take)] for i in range(take)}) if take else []
            dice.shuffle(spread)
            groups.append([(kind, number, what) for number in spread])
    faults = []
    while len(faults) < wanted and any(groups):
        dice.shuffle(groups)
        faults += [group.pop() for group in groups if group]
    return faults[:wanted]


def compile_shim(folder):
    shim = folder + '/shim.so'
    subprocess.run([os.environ.get('CC', 'cc'), '-std=gnu11', '-O1', '-shared', '-fPIC', '-o', shim,
                    os.path.join(ROOT, 'tests/faults/shim.c'), '-ldl'], check=True)
    return shim


def print_table(table, names):
    columns = sorted({what for _, what in table})
    width = max(map(len, names))
    print(f"{'faults':{width}}", *(f'{column:>7}' for column in columns), '    all')
    for name in names:
        row = [table[name, column] for column in columns]
        print(f'{name:{width}}', *(f'{value or "":>7}' for value in row), f'{sum(row):7}')
    totals = [sum(table[name, column] for name in names) for column in columns]
    print(f"{'all':{width}}", *(f'{value:7}' for value in totals), f'{sum(totals):7}')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--faults', type=int, default=600)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--only')
    parser.add_argument('--run', default=os.environ.get('SSLCD_BUILD_DIR', ROOT + '/build/release') + '/apps/sslcd_run')
    parser.add_argument('--shim')
    parser.add_argument('--verbose', action='store_true')
    options = parser.parse_args()
    binary = os.path.abspath(options.run)
    dice, table, endings, violations = random.Random(options.seed), collections.Counter(), collections.Counter(), []
    with tempfile.TemporaryDirectory(prefix='sslcd_fault_') as folder:
        folder = os.path.realpath(folder)
        shim = os.path.abspath(options.shim) if options.shim else compile_shim(folder)
        chosen = commands(options.only.split(',') if options.only else None)
        for done, command in enumerate(chosen):
            state = prepare(binary, shim, command, folder)
            wanted = (options.faults - sum(table.values())) // (len(chosen) - done)
            for fault in sample(state.counts, wanted, dice):
                trial = Trial(state, fault)
                trial.run()
                table[command.name, fault[2]] += trial.reached
                endings[trial.ending] += 1
                violations += [f'{command.name} {":".join(map(str, fault))}: {text}' for text in trial.violations]
                if options.verbose or trial.violations:
                    print(command.name, *fault, trial.ending, trial.message, *trial.violations, sep=' | ', flush=True)
    print_table(table, [command.name for command in chosen])
    print('ended:', ', '.join(f'{count} {name}' for name, count in sorted(endings.items())))
    print(f'{len(violations)} violations')
    for text in violations:
        print('  ' + text)
    sys.exit(1 if violations or not sum(table.values()) else 0)


if __name__ == '__main__':
    main()
