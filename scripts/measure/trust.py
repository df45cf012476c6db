#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what may be trusted. Called by scripts/trust.sh, which says what it does."""
import argparse
import math
import sys
from statistics import mean

from judged_runs import (JudgedRuns, add_arguments, numbers, read_attempts,
                         squared_errors_of_loops)

BINS = [-math.inf, 0, 1, 2, 3, 5, 7, math.inf]  # of the score [nats]
# A bin is off if it has this many attempts and the share right differs this much from expected.
ENOUGH, OFF = 30, 0.1
NEES = 4, 9  # what the mean of the squared errors of ENOUGH loops should be; 6 is exact


def is_harmed(row):
    """Worse than its odometry in all, horizontally or in height."""
    return any(row[part] > 1.02 * row[part + '_odometry'] + 0.02
               for part in ('ate', 'horizontal', 'height'))


def recall_of(results):
    """Over all revisited stretches; None if there are none."""
    stretches = sum(r['revisited_stretches'] for r in results)
    found = sum(r['recall'] * r['revisited_stretches'] for r in results)
    return found / stretches if stretches else None


def table_of_runs(results):
    lines = ['| world | runs | loops | wrong | recall | ATE odometry -> result [m] | worse | NEES |',
             '|---|---|---|---|---|---|---|---|']
    for name in dict.fromkeys(r['name'] for r in results):
        some = [r for r in results if r['name'] == name]
        recall = recall_of(some)
        lines.append('| ' + ' | '.join([
            name, str(len(some)), str(sum(r['loops'] for r in some)),
            str(sum(r['wrong_loops'] for r in some)), '-' if recall is None else f'{recall:.2f}',
            ', '.join(f'{r["ate_odometry"]:.2f} -> {r["ate"]:.2f}' for r in some),
            str(sum(is_harmed(r) for r in some)),
            cell_of_squared_errors([e for r in some for e in r['squared_errors']])]) + ' |')
    return lines


def cell_of_squared_errors(squared):
    if not squared:
        return '-'
    off = len(squared) >= ENOUGH and not NEES[0] <= mean(squared) <= NEES[1]
    return f'{mean(squared):.1f}' + (' off' if off else '')


def table_of_scores(attempts):
    """Reliability: is a loop with a probability of 80 % right in 80 of 100 cases?"""
    lines = ['| score [nats] | attempts | expected right | right | accepted | off |',
             '|---|---|---|---|---|---|']
    for low, high in zip(BINS, BINS[1:]):
        some = [a for a in attempts if low <= a['score'] < high]
        if not some:
            continue
        expected, right = mean(a['probability'] for a in some), mean(a['right'] for a in some)
        off = len(some) >= ENOUGH and abs(expected - right) > OFF
        lines.append(f'| {low} to {high} | {len(some)} | {expected:.3f} | {right:.3f} | '
                     f'{sum(a["accepted"] for a in some)} | {"off" if off else ""} |')
    return lines


def main():
    parser = argparse.ArgumentParser(prog='scripts/trust.sh')
    add_arguments(parser, 'runs/trust')
    parser.add_argument('--worlds', default='*', help='patterns, separated by commas')
    parser.add_argument('--seeds', default=[1, 2, 3, 4, 5], type=numbers)
    options = parser.parse_args()
    runs = JudgedRuns(options)

    def measure(sequence):
        runs.generate(sequence)
        result = runs.measure(sequence)
        if 'error' not in result:
            result['attempts'] = read_attempts(result['run'], sequence[2])
            result['squared_errors'] = squared_errors_of_loops(result['run'], sequence[2])
        return result

    results = list(runs.map(measure, runs.sequences(options.worlds, options.seeds)))
    for failed in (r for r in results if 'error' in r):
        print(f'{failed["name"]}, seed {failed["seed"]}: {failed["error"]}')
    good = [r for r in results if 'error' not in r]
    lines = [*table_of_runs(good), '', *table_of_scores([a for r in good for a in r['attempts']])]
    (options.out / 'trust.md').write_text('\n'.join([*lines, '']), encoding='utf-8')
    print('\n'.join(lines))
    wrong = sum(r['wrong_loops'] for r in good)
    worse = [f'{r["name"]}-s{r["seed"]}' for r in good if is_harmed(r)]
    print(f'{len(good)} runs, {wrong} wrong loops, {len(worse)} worse than their odometry: '
          f'{", ".join(worse)}')
    return 1 if wrong or worse or len(good) < len(results) else 0


if __name__ == '__main__':
    sys.exit(main())
