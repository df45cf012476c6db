# SPDX-License-Identifier: BSD-3-Clause
"""The part `worlds`: random HALV-sim worlds, to find those that go wrong.

What a world is like is drawn from its number alone: the case, the layout, size and speed, how many
places are taken and how many vehicles change between the passes, drift of the odometry, and noise of
the detector. Each result is a line of runs/worlds/COMMIT.jsonl, so that an interrupted measurement
goes on where it was."""
import json
import os
import random
import subprocess
import tempfile

from program import rounded
from store import fingerprint, last_code_commit

WORLDS = 1000
HARM = 1.02, 0.02  # worse than the odometry by this factor and by so many metres
USUAL_NOISE = 1.85  # HALV-sim's DetectorNoise::scale
KEPT = ['ate_se3_rmse_m', 'odometry_ate_se3_rmse_m', 'ate_sim3_rmse_m', 'odometry_ate_sim3_rmse_m',
        'path_m', 'loops', 'loops_wrong', 'loops_wrong_in_height', 'revisited_stretches',
        'revisits_recognised']


def drawn(number):
    """The arguments of `sslcd_sim halv` for a world. Odometry is up to four times as bad and the
    detector up to twice as bad as HALV-sim's usual ones."""
    draw = random.Random(number)

    def between(low, high, digits=3):
        return round(low + (high - low) * draw.random(), digits)

    def one_of(values):
        return values[int(draw.random() * len(values))]

    case = 1 + int(4 * draw.random())
    usual_ate_m = [1.7, 1.3, 0.9, 0.6][case - 1]  # about what HALV-sim's cases have
    return {'case': case, 'seed': 100000 + number, 'layout': one_of(['lot', 'lot', 'street']),
            'size': between(0.6, 1.4), 'speed-mps': between(1, 6), 'keyframe-hz': one_of([2, 3, 5]),
            'taken-fraction': between(0.25, 0.95), 'van-fraction': between(0, 0.3),
            'truck-fraction': between(0, 0.1), 'marks': one_of(['true', 'true', 'false']),
            'churn': one_of([0, 0, 0.1, 0.3, 0.5]), 'driving-cars': int(7 * draw.random()),
            'ate-m': round(usual_ate_m * 2 ** between(-2, 2), 3), 'scale-error': between(-0.03, 0.03, 4),
            'scale': between(0.5, 3.7), 'miss-rate-near': between(0, 0.2),
            'wrong-label': between(0, 0.1), 'false-positives': between(0, 1),
            'max-range-m': between(20, 50, 1)}


def flags(world):
    return [word for name, value in world.items() for word in (f'--{name}', str(value))]


class Failed(Exception):
    """A command ended with an exit code that is none."""


def call(command):
    """Standard output, or None and the message of an error that the command reports."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode < 0 or done.returncode > 5:
        raise Failed(f'{" ".join(command)}: {done.returncode}')
    return (done.stdout, '') if done.returncode == 0 else (None, done.stderr.strip())


def measure_world(number, program):
    """The figures of a world, or the reason why there is no such world."""
    with tempfile.TemporaryDirectory() as folder:
        made, refusal = call([program.beside('apps/sslcd_sim'), 'halv', *flags(drawn(number)),
                              '--out', folder + '/world'])
        if made is None:
            return {'world': number, 'refused': refusal[:200]}
        text, problem = call([program.path, 'run', folder + '/world', '--groundtruth',
                              'groundtruth.txt', '--out', folder + '/run', '--json'])
        if text is None:
            raise Failed(f'world {number}: {problem}')
    figures = json.loads(text)
    return {'world': number, **{key: rounded(figures.get(key)) for key in KEPT}}


def ratio(result):
    return result['ate_se3_rmse_m'] / max(result['odometry_ate_se3_rmse_m'], 1e-3)


def is_harmed(result):
    factor, more_m = HARM
    return result['ate_se3_rmse_m'] > factor * result['odometry_ate_se3_rmse_m'] + more_m


def badness(result):
    """Wrong loops first, then the error relative to that of the odometry."""
    return (result['loops_wrong'], ratio(result))


def sums(good):
    ratios = sorted(ratio(r) for r in good)

    def quantile(share):
        return rounded(ratios[int(share * (len(ratios) - 1))])

    return {'worlds': len(good), 'without_loops': sum(r['loops'] == 0 for r in good),
            'loops': sum(r['loops'] for r in good), 'wrong': sum(r['loops_wrong'] for r in good),
            'worlds_with_wrong': sum(r['loops_wrong'] > 0 for r in good),
            'harmed': sum(map(is_harmed, good)), 'ratio_p50': quantile(0.5),
            'ratio_p90': quantile(0.9), 'ratio_p99': quantile(0.99)}


def summary(results):
    good = [{**r, 'drawn': drawn(r['world'])} for r in results if 'refused' not in r]
    worst = sorted(good, key=badness, reverse=True)[:10]
    return {'usual': sums([r for r in good if r['drawn']['scale'] <= USUAL_NOISE]),
            'noisy': sums([r for r in good if r['drawn']['scale'] > USUAL_NOISE]),
            'refused': len(results) - len(good), 'worst': worst}


class Worlds:
    """All worlds as one set."""
    name, role, missing = 'worlds/halv', 'held-out', None

    def fingerprint(self):
        return fingerprint([], WORLDS, *(drawn(number) for number in range(5)))

    def measure(self, program):
        os.nice(10)
        os.makedirs('runs/worlds', exist_ok=True)
        path = f'runs/worlds/{last_code_commit(program.built)}-{self.fingerprint()}.jsonl'
        known = {}
        if os.path.exists(path):
            with open(path, encoding='utf-8') as file:
                lines = [line for line in file if line.endswith('\n')]  # the last may be cut
            known = {r['world']: r for r in map(json.loads, lines)}
        with open(path, 'w', encoding='utf-8') as file:
            file.writelines(json.dumps(result) + '\n' for result in known.values())
            file.flush()
            for number in range(WORLDS):
                if number in known:
                    continue
                known[number] = measure_world(number, program)
                file.write(json.dumps(known[number]) + '\n')
                file.flush()
        return summary([known[number] for number in range(WORLDS)])


def world_sets(_data):
    return [Worlds()]
