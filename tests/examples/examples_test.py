#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs examples and judges the figures that they print.

    examples_test.py PROGRAM...
"""
import os
import re
import subprocess
import sys
import tempfile

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../data')
FOLDER = tempfile.TemporaryDirectory()
ATE = r'ATE ([\d.]+) m, of the odometry ([\d.]+) m'


def is_better(ate, odometry):
    return float(ate) < 0.6 * float(odometry)


# name: arguments, what the last line has to match, what its figures have to be
EXAMPLES = {
    '01_streaming': ([], ATE, is_better),
    '02_own_pose_graph': (['sim_rectangle'], r'(\d+) loops kept, (\d+) refused; ' + ATE,
                          lambda kept, refused, *ate:
                          int(kept) >= 5 and int(refused) <= 1 and is_better(*ate)),
    '03_own_matcher': (['sim_out_and_back'], r'(\d+) loops; ' + ATE,
                       lambda loops, *ate: int(loops) >= 2 and is_better(*ate)),
    '04_images': ([], r'(\d+) cars, moved ([\d.]+) m',
                  lambda cars, moved: int(cars) == 4 and abs(float(moved) - 5.7) < 0.06),
    '05_two_sequences': (['sim_rectangle'], r'(\d+) loops join the sequences; ATE of both ([\d.]+) m',
                         lambda loops, ate: int(loops) >= 10 and float(ate) < 0.8),
    '06_asynchronous': (['sim_rectangle'], r'(\d+) frames, (\d+) loops; ATE ([\d.]+) m',
                        lambda frames, loops, ate:
                        int(frames) == 265 and int(loops) >= 10 and float(ate) < 0.4),
    '07_map_file': (['sim_rectangle', os.path.join(FOLDER.name, 'site.db')],
                    r'(\d+) frames before tuesday, (\d+) loops join the sessions',
                    lambda frames, loops: int(frames) == 265 and int(loops) >= 10),
    '08_relocalise': (['sim_rectangle', os.path.join(FOLDER.name, 'site.db')],
                      r'frame (\d+) is at .*', lambda frame: int(frame) < 150),
}
# an example that makes the input of another one
BEFORE = {'08_relocalise': '07_map_file'}


def problem_of(program):
    """None, or why the example is wrong."""
    name = os.path.basename(program)
    arguments, pattern, is_right = EXAMPLES[name]
    made = os.path.exists(arguments[-1]) if name in BEFORE else True
    if not made and problem_of(os.path.join(os.path.dirname(program), BEFORE[name])):
        return f'{BEFORE[name]} fails'
    run = subprocess.run([program] + [os.path.join(DATA, name) for name in arguments],
                         stdout=subprocess.PIPE, text=True, timeout=60, check=False)
    print(run.stdout, end='')
    found = re.fullmatch(pattern, run.stdout.strip().rsplit('\n', maxsplit=1)[-1])
    if run.returncode != 0:
        return f'exit code {run.returncode}'
    if not found:
        return f'does not print /{pattern}/'
    return None if is_right(*found.groups()) else 'the figures are wrong'


def main():
    problems = {program: problem_of(program) for program in sys.argv[1:]}
    for program, problem in problems.items():
        if problem:
            print(f'{program}: {problem}', file=sys.stderr)
    sys.exit(not problems or any(problems.values()))


if __name__ == '__main__':
    main()
