#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the figures of docs/figures.json. Called by scripts/measure.sh in the repository's root."""
import argparse
import datetime
import os

from bench import bench_sets
from change import change_sets
from fleet import fleet_sets
from halv import halv_sets
from pairs import city_sets, pair_sets
from program import Program, processor
from properties import property_sets
from retrieval import retrieval_sets
from runs import kitti_sets, loop_sets
from sessions import relocalise_sets, session_sets
from soak import soak_sets
from stream import stream_sets
from store import Store, last_code_commit, same_code
from worlds import world_sets

PARTS = {'loops': loop_sets, 'kitti': kitti_sets, 'pairs': pair_sets, 'city': city_sets,
         'halv': halv_sets, 'sessions': session_sets, 'relocalise': relocalise_sets, 'retrieval': retrieval_sets,
         'change': change_sets, 'fleet': fleet_sets, 'stream': stream_sets, 'bench': bench_sets,
         'properties': property_sets, 'soak': soak_sets, 'worlds': world_sets}
USUAL = ['loops', 'kitti', 'pairs']  # what takes seconds a set


def measure_set(one, program, store, code, force):
    """Returns 'measured', 'kept' or the reason for skipping."""
    if one.missing:
        return f'skipped: no {one.missing}'
    inputs = one.fingerprint()
    known = store.sets.get(one.name)
    if known and not force and known['inputs'] == inputs and same_code(known['commit'], code):
        return 'kept'
    figures = one.measure(program)
    store.put(one.name, {'commit': code, 'date': datetime.date.today().isoformat(),
                         'cpu': processor(), 'inputs': inputs, 'role': one.role,
                         'figures': figures})
    return 'measured'


def parse_arguments():
    parser = argparse.ArgumentParser(prog='scripts/measure.sh')
    parser.add_argument('--build', default='build/release')
    parser.add_argument('--data', default='../shared/data')
    parser.add_argument('--figures', default='docs/figures.json')
    parser.add_argument('--only', help='parts, separated by commas: ' + ', '.join(PARTS))
    parser.add_argument('--force', action='store_true', help='measure known sets, too')
    parser.add_argument('--list', action='store_true', help='print the sets and their state')
    arguments = parser.parse_args()
    arguments.parts = arguments.only.split(',') if arguments.only else USUAL
    for part in arguments.parts:
        if part not in PARTS:
            parser.error(f"no part '{part}'; there are {', '.join(PARTS)}")
    return arguments


def main():
    arguments = parse_arguments()
    store = Store(arguments.figures)
    data = os.path.realpath(arguments.data)
    sets = [one for part in arguments.parts for one in PARTS[part](data)]
    if arguments.list:
        for one in sets:
            known = store.sets.get(one.name)
            print(f'{one.name}: ' + (f'{known["date"]}, {known["commit"]}' if known else '-'))
        return
    program = Program(arguments.build)
    if not os.path.exists(program.path):
        raise SystemExit(f'no {program.path}: build it, or set SSLCD_BUILD_DIR')
    code = last_code_commit(program.built)
    print(f'code: {code}')
    for one in sets:
        state = measure_set(one, program, store, code, arguments.force)
        print(f'{one.name}: {state}', flush=True)


if __name__ == '__main__':
    main()
