# SPDX-License-Identifier: BSD-3-Clause
"""The part `halv`: `sslcd_run bench` on HALV-sim. Thresholds were chosen on seeds 1 to 10, and
nothing was chosen on seeds 11 to 20."""
import glob
import json
import math
import os
import re

from program import rounded
from store import fingerprint

CASES = range(1, 5)
TRUE_LOOP_M = 5.  # the paper's tau_L
NEAR_M = 5.       # of path between a keyframe and a loop that recognises it
BINS = [(0, 45), (45, 90), (90, 135), (135, 180)]  # change of viewpoint [degrees]
FOLDER = 'runs/measure'  # of the benchmark, for each commit


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def median(values):
    ordered = sorted(values)
    middle = len(ordered) // 2
    return ordered[middle] if len(ordered) % 2 else (ordered[middle - 1] + ordered[middle]) / 2


def in_bin(angle_rad, bounds):
    degrees = math.degrees(angle_rad)
    return bounds[0] <= degrees and (degrees < bounds[1] or bounds[1] == 180)


def recognised(revisit, loops):
    return any(loop['accepted'] and loop['error_m'] < TRUE_LOOP_M
               and abs(loop['at_m'] - revisit['at_m']) <= NEAR_M for loop in loops)


def viewpoint_figures(trials, bounds):
    """Keyframes to recognise and loops of one bin of the change of viewpoint."""
    found = [recognised(revisit, trial['loops']) for trial in trials
             for revisit in trial['revisits'] if in_bin(revisit['viewpoint_rad'], bounds)]
    loops = [loop for trial in trials for loop in trial['loops']
             if loop['accepted'] and in_bin(loop['viewpoint_rad'], bounds)]
    errors = [loop['error_m'] for loop in loops if loop['error_m'] < TRUE_LOOP_M]
    return {'keyframes': len(found), 'recognised': sum(found), 'loops': len(loops),
            'wrong': len(loops) - len(errors),
            'error_median_m': rounded(median(errors)) if errors else None}


def summarise(trials):
    """`trials`: {(case, seed): result file of one run}."""
    figures = {}
    for case in CASES:
        of_case = [trial for (number, _), trial in trials.items() if number == case]
        figures[f'case {case}'] = {
            'odometry_ate_sim3_rmse_m': rounded(mean(t['ate_odometry']['rmse'] for t in of_case)),
            'ate_sim3_rmse_m': rounded(mean(t['ate']['rmse'] for t in of_case)),
            'ate_sim3_max_m': rounded(mean(t['ate']['max'] for t in of_case)),
            'ate_se3_rmse_m': rounded(mean(t['ate_se3']['rmse'] for t in of_case))}
    for bounds in BINS:
        figures[f'{bounds[0]}-{bounds[1]} degrees'] = viewpoint_figures(trials.values(), bounds)
    figures['all'] = viewpoint_figures(trials.values(), (0, 180))
    return figures


class Halv:
    """Ten seeds of each of the four cases."""

    def __init__(self, name, role, seeds):
        self.name, self.role, self.seeds = name, role, seeds
        self.arguments = ['table2', '--methods', 'sslcd', '--seeds', str(seeds[-1])]
        self.missing = None

    def fingerprint(self):
        return fingerprint([], *self.arguments, *self.seeds)

    def measure(self, program):
        # one folder per commit, since the benchmark refuses results of another one
        folder = os.path.join(FOLDER, program.built)
        program.run(['bench', *self.arguments, '--out', folder, '--quiet'])
        trials = {}
        for path in glob.glob(os.path.join(folder, 'trials', 'lot-c*-s*-sslcd.json')):
            case, seed = map(int, re.search(r'lot-c(\d+)-s(\d+)-', path).groups())
            if seed in self.seeds:
                with open(path, encoding='utf-8') as file:
                    trials[case, seed] = json.load(file)
        return summarise(trials)


def halv_sets(_):
    return [Halv('halv/seeds 1-10', 'development', range(1, 11)),
            Halv('halv/seeds 11-20', 'held-out', range(11, 21))]
