# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/properties.md."""
from cells import arrow, note, number, table

PROPERTIES = {'properties/halv': 'HALV-sim', 'properties/poles 05': 'poles 05'}
COMMAND = 'scripts/measure.sh --only properties,soak,worlds'


def properties(sets):
    rows = []
    for name, title in PROPERTIES.items():
        for what, f in sets[name]['figures'].items():
            rows.append([what, f'{title}, {f["drives"]}', arrow(f['loops'], f['loops_changed'], 0),
                         f['in_common'], f['wrong_changed'], arrow(f['ate'], f['ate_changed'], 3),
                         f'{f["farthest_m"]:.1g}'])
    header = ['change of the input', 'drives', 'pairs of frames joined by loops', 'the same pairs', 'wrong',
              'mean ATE [m]', 'largest change of a position [m]']
    return table(header, rows) + note([sets[name] for name in PROPERTIES], COMMAND)


def soak(sets):
    names = [name for name in ('soak/a mapper each', 'soak/one mapper') if name in sets]
    rows = []
    for name in names:
        for f in sets[name]['figures']['rounds']:
            rows.append([name.removeprefix('soak/'), f'{f["round"]:.0f}', f'{f["frames"]:.0f}',
                         number(f['p50_ms'], 3), number(f['p99_ms'], 2), number(f['max_ms'], 0),
                         number(f['used_MiB'], 2), number(f['resident_MiB'], 0), f['same_results']])
    header = ['mappers', 'round', 'frames so far', 'CPU time of `AddFrame`, p50 [ms]', 'p99 [ms]',
              'longest [ms]', 'memory in use [MiB]', 'resident [MiB]', 'results of the first round']
    return table(header, rows) + note([sets[name] for name in names], COMMAND)


def worlds(sets):
    entry = sets['worlds/halv']
    rows = []
    for title, f in (('noise of the detector up to that of HALV-sim', entry['figures']['usual']),
                     ('up to twice that', entry['figures']['noisy'])):
        rows.append([title, f['worlds'], f['without_loops'], f['loops'], f['wrong'],
                     f['worlds_with_wrong'], f['harmed'],
                     ' / '.join(number(f[f'ratio_p{p}']) for p in (50, 90, 99))])
    header = ['worlds', 'number', 'without a loop', 'loops', 'wrong', 'worlds with a wrong one',
              'worse than the odometry', 'error / that of the odometry: p50 / p90 / p99']
    return table(header, rows) + note([entry], COMMAND)


def worlds_worst(sets):
    rows = []
    for f in sets['worlds/halv']['figures']['worst']:
        drawn = f['drawn']
        rows.append([f['world'], f'{drawn["case"]}, {drawn["layout"]}', number(drawn['scale'], 1),
                     f'{drawn["max-range-m"]:.0f}', f'{100 * drawn["churn"]:.0f} %',
                     f'{f["loops"]}, {f["loops_wrong"]}',
                     arrow(f['odometry_ate_se3_rmse_m'], f['ate_se3_rmse_m']),
                     arrow(f['odometry_ate_sim3_rmse_m'], f['ate_sim3_rmse_m'])])
    header = ['world', 'case, layout', 'noise of the detector (HALV-sim: 1.85)', 'range [m]',
              'vehicles replaced', 'loops, wrong', 'ATE: odometry -> sslcd [m]', 'after Sim(3)']
    return table(header, rows)
