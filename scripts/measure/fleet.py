# SPDX-License-Identifier: BSD-3-Clause
"""The part `fleet`: maps of many drives, by bench/fleet_bench.py."""
import json
import os
import subprocess

from cells import note, number, table
from program import rounded
from store import fingerprint

COMMAND = 'scripts/measure.sh --only fleet'
STAGES = ('map', 'index', 'rank', 'verify', 'solve')


def in_numbers(value):
    """All numbers of a document, rounded."""
    if isinstance(value, dict):
        return {key: in_numbers(one) for key, one in value.items()}
    if isinstance(value, list):
        return [in_numbers(one) for one in value]
    return rounded(value)


class Fleet:
    """One of the measurements of bench/fleet_bench.py."""
    missing = None
    role = 'development'

    def __init__(self, what):
        self.what, self.name = what, f'fleet/{what}'

    def fingerprint(self):
        return fingerprint(['bench/fleet_bench.py'], self.what)

    def measure(self, program):
        package = os.path.dirname(os.path.dirname(program.beside('python/sslcd/__init__.py')))
        done = subprocess.run(['/usr/bin/python3', '-B', 'bench/fleet_bench.py', self.what,
                               program.beside('apps/sslcd_sim')], check=True, stdout=subprocess.PIPE,
                              text=True, env={**os.environ, 'PYTHONPATH': package})
        return {'result': in_numbers(json.loads(done.stdout))}


def fleet_sets(_data):
    return [Fleet(what) for what in ('sites', 'merge', 'many')]


# Tables

def fleet(sets):
    """How the builds ended."""
    result = sets['fleet/sites']['figures']['result']
    builds = [('60 drives, one worker', result['one']), ('60 drives, two workers', result['two']),
              ('60 drives, two workers, three times one is killed', result['killed'])]
    entries = [sets['fleet/sites']]
    if 'fleet/many' in sets:
        builds.append(('500 small drives, two workers', sets['fleet/many']['figures']['result']))
        entries.append(sets['fleet/many'])
    first = result['one']['export']
    rows = [[title, f'{one["right"]} of {one["sites"]}', one['wrong_merges'], one['left_out'],
             ('yes' if one['export'] == first else 'no') if '60' in title else '-',
             number(one['cpu_s'], 0), number(one['wall_s'], 0),
             number(one['speedup_by_cpu']) if one is result['two'] else '-',
             number(one['memory_bytes'] / 1e9) if 'memory_bytes' in one else '-'] for title, one in builds]
    header = ['build', 'sites right', 'wrong merges', 'drives left out', 'same bytes as with one worker',
              'processor time [s]', 'on the clock [s]', 'speed-up of two free cores, computed',
              'memory of all processes [GB]']
    return table(header, rows) + note(entries, COMMAND)


def fleet_stages(sets):
    """The cost of a task of each stage."""
    rows = []
    builds = {'60 drives': sets['fleet/sites']['figures']['result']['one']}
    if 'fleet/many' in sets:
        builds['500 small drives'] = sets['fleet/many']['figures']['result']
    for title, build in builds.items():
        for stage in STAGES:
            one = build['stages'][stage]
            rows.append([title, stage, one['tasks'], one['skipped'], number(one['cpu_s'], 1),
                         number(one['cpu_s'] / max(one['tasks'], 1)), number(one['longest_s']),
                         number(one['bytes'] / 1e6, 1)])
    header = ['build', 'stage', 'tasks', 'not necessary', 'processor time [s]', 'a task [s]',
              'the longest task [s]', 'outputs [MB]']
    measured = [sets[name] for name in ('fleet/sites', 'fleet/many') if name in sets]
    return table(header, rows) + note(measured, COMMAND)


def fleet_merge(sets):
    """The cost of a site by the number of its drives."""
    result = sets['fleet/merge']['figures']['result']
    rows = [[one['site'], one['drives'], one['frames'], number(one['cpu_s'], 1),
             number(one['cpu_s'] / one['drives']), number(one['bytes'] / 1e6, 1)] for one in result]
    header = ['site', 'drives', 'frames', 'processor time [s]', 'a drive [s]', 'map [MB]']
    return table(header, rows) + note([sets['fleet/merge']], COMMAND)
