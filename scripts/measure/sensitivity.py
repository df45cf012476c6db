#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Halves and doubles options. Called by scripts/sensitivity.sh, which says what it does."""
import argparse
import re
import subprocess
import sys
from collections import namedtuple
from statistics import mean

from judged_runs import JudgedRuns, add_arguments, is_wanted, numbers
from trust import recall_of

SETS = ('victoria-park,kitti-odometry-poles/05,forest-evo-fwd,'
        'b2_d60,d_trees8_laps,e_row5_j3,f_common6,h_jump,i_floors_diff,k_suburb')
UNUSED = 'loop.paper.*,loop.views.*'  # of the printed finder, and of images
LEAST_LOOPS = 0.9  # of those with the defaults
# There is one attempt per this length of path, so half as many loops are no loss where it doubles.
PATH_PER_ATTEMPT = 'loop.layout.every_m'

Option = namedtuple('Option', 'key value low high is_integer')
Figures = namedtuple('Figures', 'loops wrong recall ate')


def parse_options(markdown):
    """The numbers among the options of `sslcd_run dump-config --markdown`."""
    options, section = [], ''
    for line in markdown.splitlines():
        heading = re.fullmatch(r'## `(.*)`', line)
        row = re.match(r'\| `(\w+)` \| (number|integer) \| (\S+) \| (\S+) \.\. (\S+) \|', line)
        if heading:
            section = heading.group(1) + '.'
        elif row:
            key, kind, *values = row.groups()
            options.append(Option(section + key, *map(float, values), kind == 'integer'))
    return options


def other_values(option):
    """Half and twice the default, within the range."""
    values = []
    for factor in (0.5, 2):
        value = factor * option.value
        if option.is_integer:
            value = int(value)
        value = min(max(value, option.low), option.high)
        if value != option.value:
            values.append(f'{value:.9g}')
    return values


def is_allowed(program, option, value):
    """False where it does not fit the other defaults."""
    return subprocess.run([program, 'dump-config', '--set', f'{option.key}={value}'],
                          capture_output=True).returncode == 0


def figures_of(results):
    """Of the runs of a set, added up; the ATE is their mean."""
    return Figures(sum(r['loops'] for r in results), sum(r['wrong_loops'] for r in results),
                   recall_of(results), mean(r['ate'] for r in results))


def is_sensitive(default, changed, path_per_loop=1.):
    """`path_per_loop`: relative to the default."""
    return (changed.loops * path_per_loop < LEAST_LOOPS * default.loops or
            changed.wrong > default.wrong)


def path_per_loop(option, value):
    return float(value) / option.value if option.key == PATH_PER_ATTEMPT else 1.


def cell_of_default(figures):
    recall = '-' if figures.recall is None else f'{figures.recall:.2f}'
    return f'{figures.loops} loops, {figures.wrong} wrong, {recall}, {figures.ate:.2f} m'


def cell(default, changed, marked):
    """Loops, wrong loops, recall and ATE relative to those of the defaults."""
    loops = f'{100 * (changed.loops / default.loops - 1):+.0f} %' if default.loops else '-'
    recall = ('-' if None in (changed.recall, default.recall)
              else f'{changed.recall - default.recall:+.2f}')
    ate = f'x{changed.ate / default.ate:.2f}' if default.ate else '-'
    text = f'{loops}, {changed.wrong - default.wrong:+d}, {recall}, {ate}'
    return f'**{text}**' if marked else text


def set_of(result):
    return result['name'] if result['seed'] == 0 else 'worlds'


def by_set(results):
    """Figures by set; None if a run failed."""
    sets = {}
    for result in results:
        sets.setdefault(set_of(result), []).append(result)
    return {name: None if any('error' in r for r in some) else figures_of(some)
            for name, some in sets.items()}


def row_of(option, value, default, changed):
    """A row of the table, and whether it is marked."""
    cells, marked = [], False
    for name, before in default.items():
        after = changed[name]
        mark = after is None or is_sensitive(before, after, path_per_loop(option, value))
        cells.append('**failed**' if after is None else cell(before, after, mark))
        marked = marked or mark
    return f'| `{option.key}` | {value} | {" | ".join(cells)} |', marked


def head_of_table(default):
    return ['Loops, wrong loops, recall and ATE relative to the defaults; bold: too sensitive.', '',
            f'| option | value | {" | ".join(default)} |', '|---' * (2 + len(default)) + '|',
            f'| defaults | | {" | ".join(map(cell_of_default, default.values()))} |']


def judge(runs, sequences, changes):
    """Yields figures by set of the defaults, then of each change."""
    settings = [(), *((f'{option.key}={value}',) for option, value in changes)]
    jobs = [(sequence, some) for some in settings for sequence in sequences]
    results = runs.map(lambda job: runs.measure(job[0], '/'.join(('runs', *job[1])), job[1]), jobs)
    for some in settings:
        judged = [next(results) for _ in sequences]
        for failed in (r for r in judged if 'error' in r):
            print(f'{failed["name"]}, seed {failed["seed"]}, {some}: {failed["error"]}',
                  file=sys.stderr)
        yield by_set(judged)


def main():
    parser = argparse.ArgumentParser(prog='scripts/sensitivity.sh')
    add_arguments(parser, 'runs/sensitivity')
    parser.add_argument('--options', default='loop.*', help='patterns, separated by commas')
    parser.add_argument('--sets', default=SETS, help='patterns, separated by commas')
    parser.add_argument('--seeds', default=[1], type=numbers)
    arguments = parser.parse_args()
    runs = JudgedRuns(arguments)
    sequences = runs.sequences(arguments.sets, arguments.seeds)
    list(runs.map(runs.generate, sequences))
    markdown = subprocess.run([runs.program, 'dump-config', '--markdown'], check=True,
                              capture_output=True, text=True).stdout
    changes = [(option, value) for option in parse_options(markdown)
               if is_wanted(option.key, arguments.options) and not is_wanted(option.key, UNUSED)
               for value in other_values(option) if is_allowed(runs.program, option, value)]
    judged = judge(runs, sequences, changes)
    default = next(judged)
    if not default or None in default.values():
        sys.exit('no figures of the defaults')
    marked = []
    with open(arguments.out / 'sensitivity.md', 'w', encoding='utf-8') as file:
        def write(line):
            print(line, flush=True)
            print(line, file=file, flush=True)
        for line in head_of_table(default):
            write(line)
        for (option, value), changed in zip(changes, judged):
            line, mark = row_of(option, value, default, changed)
            write(line)
            if mark:
                marked.append(f'{option.key}={value}')
    print(f'{len(changes)} changes, {len(marked)} too sensitive: {", ".join(marked)}')
    return 1 if marked else 0


if __name__ == '__main__':
    sys.exit(main())
