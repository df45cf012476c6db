# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the documents, as Markdown, from the sets of docs/figures.json."""
import functools
import math

from cells import LOOPS, arrow, mean, note, number, percent, role, table
from pairs import CITY_OBJECTS
from fleet import fleet, fleet_merge, fleet_stages
from retrieval_tables import retrieval, retrieval_real, retrieval_size
from soak_tables import properties, soak, worlds, worlds_worst
from session_tables import (change, change_still, relocalise, relocalise_halv, sessions,
                            sessions_halv)

LIDAR, STEREO = 'kitti/det_pointrcnn_car/', 'kitti/det_stereo_grade_car/'
SCENES = ['street', 'lot']
CASES = [1, 2, 3, 4]
BINS = ['0-45', '45-90', '90-135', '135-180']
PAPER_ATE = {'case 1': 0.501, 'case 2': 0.550, 'case 3': 0.368, 'case 4': 0.161}  # its Table II
KNOWN, FRESH = 'halv/seeds 1-10', 'halv/seeds 11-20'
BENCH = {'bench/all': 'sslcd_run bench all',
         'bench/images': 'sslcd_run bench viewpoint --images IMAGES'}


def loops(sets):
    names = [name for name in LOOPS if name in sets]
    entries = [sets[name] for name in names]
    figures = [entry['figures'] for entry in entries]

    def row(title, cell):
        return [title] + [cell(f) for f in figures]

    def bins(f):
        return ' / '.join(str(f[f'loops_true_{name}_deg']) for name in BINS)

    rows = [
        ['options were chosen on it'] + [role(entry) for entry in entries],
        row('path [m]', lambda f: number(f['path_m'], 0)),
        row('ATE of the odometry [m]', lambda f: number(f['odometry_ate_se3_rmse_m'])),
        row('**ATE with object loops [m]**', lambda f: number(f['ate_se3_rmse_m'])),
        row('loops accepted', lambda f: f['loops']),
        row('wrong (off by 5 m horizontally, 1.5 m in height or 5 degrees)',
            lambda f: f['loops_wrong']),
        row('true loops by viewpoint change 0-45 / 45-90 / 90-135 / 135-180 degrees', bins),
        row('revisited stretches', lambda f: f['revisited_stretches']),
        row('of them recognised', lambda f: percent(f['revisits_recognised'])),
        row('median error of a loop [m]', lambda f: number(f['loop_error_median_m'])),
        row('median error of a loop [degrees]',
            lambda f: number(math.degrees(f['loop_error_median_rad']))),
        row('landmarks in the map', lambda f: f['landmarks']),
        row('landmarks per true object', lambda f: number(f['landmarks_per_true'])),
        row('purity', lambda f: number(f['purity'], 3)),
        row('CPU time of the run [s]', lambda f: number(f['cpu_s'], 1)),
        row('peak memory [MiB]', lambda f: number(f['memory_mib'], 0)),
    ]
    return table(['', *(LOOPS[name] for name in names)], rows) + note(entries)


def of_kitti(sets):
    for prefix, title in ((LIDAR, 'LiDAR (PointRCNN)'), (STEREO, 'stereo grade (simulated noise)')):
        for name in sorted(sets):
            if name.startswith(prefix):
                yield title, name[len(prefix):], sets[name]


def kitti_ate(sets):
    entries = [(t, s, e) for t, s, e in of_kitti(sets) if 'ate_se3_rmse_m' in e['figures']]
    rows = []
    for title, sequence, entry in entries:
        f = entry['figures']
        rows.append([title, sequence,
                     arrow(f['odometry_ate_se3_rmse_m'], f['ate_se3_rmse_m']),
                     arrow(f['odometry_ate_sim3_rmse_m'], f['ate_sim3_rmse_m'])])
    header = ['detections', 'sequence', 'ATE after SE(3): odometry -> sslcd [m]',
              'ATE after Sim(3): odometry -> sslcd [m]']
    return table(header, rows) + note(e for _, _, e in entries)


def kitti_map(sets):
    rows, entries = [], []
    for title, sequence, entry in of_kitti(sets):
        f = entry['figures']
        if 'iou_map' not in f:
            continue
        entries.append(entry)
        rows.append([title, sequence, arrow(f['iou_raw'], f['iou_map'], 3), percent(f['coverage']),
                     number(f['purity'], 3), number(f['static_found'], 3),
                     number(f['landmarks_per_static']), number(f['driving_in_map'])])
    header = ['detections', 'sequence', '3D IoU: detector -> map', 'coverage', 'purity',
              'parked cars found', 'landmarks per parked car', 'driving cars in the map']
    return table(header, rows) + note(entries)


def kitti_scale(sets):
    """The odometry after correction by the true scale, which only the ground truth gives."""
    figures = [e['figures'] for t, _, e in of_kitti(sets)
               if t.startswith('LiDAR') and 'ate_se3_rmse_m' in e['figures']]

    def row(title, prefix):
        return [title] + [number(mean(f[f'{prefix}ate_{alignment}_rmse_m'] for f in figures))
                          for alignment in ('se3', 'sim3')]

    header = [f'mean ATE of {len(figures)} KITTI sequences [m]', 'as estimated, after SE(3)',
              'with the best single scale, after Sim(3)']
    return table(header, [row('odometry', 'odometry_'), row('sslcd', '')])


def pairs(sets):
    entries = [(name, sets[name]) for name in sorted(sets) if name.startswith('pairs/')]
    entries.sort(key=lambda item: item[1]['role'])
    rows = []
    for name, entry in entries:
        f = entry['figures']
        rows.append([name[len('pairs/'):], role(entry)] +
                    [f'{f[s]["right"]} / {f[s]["wrong"]} / {f[s]["refused"]} of {f[s]["pairs"]}'
                     for s in SCENES] + [' / '.join(number(f[s]['ms_p50']) for s in SCENES)])
    header = ['pairs', 'options were chosen on it', 'streets: right / wrong / refused',
              'lots: right / wrong / refused', 'median time: street / lot [ms]']
    return table(header, rows) + note(entry for _, entry in entries)


def city(sets):
    entries = [entry for name, entry in sets.items() if name.startswith('city/')]
    rows = []
    for name in [f'city/{scene} {n}' for scene in SCENES for n in CITY_OBJECTS]:
        scene, count = name.removeprefix('city/').split()
        there, absent = (sets[name]['figures'][s] for s in (scene, scene + '-absent'))
        rows.append([f'{scene}s', count,
                     f'{there["right"]} / {there["wrong"]} of {there["pairs"]}',
                     f'{there["right_sure"]} / {there["wrong_sure"]}',
                     f'{absent["wrong"]} / {absent["wrong_sure"]} of {absent["pairs"]}',
                     f'{number(there["ms_p50"], 1)} / {number(there["ms_p95"], 1)}',
                     round(sets[name]['figures']['memory_mib'])])
    header = ['map', 'objects', 'right / wrong', 'at a score of 5: right / wrong',
              'absent places accepted / at 5', 'time p50 / p95 [ms]', 'peak memory [MiB]']
    return table(header, rows) + note(entries, 'scripts/measure.sh --only city')


def stream(sets):
    entries = {name.removeprefix('stream/'): entry for name, entry in sets.items()
               if name.startswith('stream/')}
    rows = []
    for name, entry in entries.items():
        f = entry['figures']
        quarters = (number(f[f'{which}_quarter_p99_ms'], 1) for which in ('first', 'last'))
        rows.append([name, round(f['frames']), number(f['p50_ms'], 1), number(f['p99_ms'], 1),
                     ' / '.join(quarters), number(f['max_ms'], 1), round(f['dropped']),
                     f'{f["loops"]:.0f}, {number(f["ATE_m"])}',
                     f'{f["loops_refined"]:.0f}, {number(f["ATE_refined_m"])}',
                     number(f['KiB_per_frame'], 1)])
    header = ['sequence', 'frames', 'call p50 [ms]', 'p99 [ms]', 'p99 of the first / last quarter',
              'longest [ms]', 'frames dropped', 'loops and ATE [m] after the last frame',
              'after a last Refine()', 'memory per frame [KiB]']
    return table(header, rows) + note(entries.values(), 'scripts/measure.sh --only stream')


def halv_ate(sets):
    rows = []
    for name, title in ((KNOWN, 'seeds 1-10'), (FRESH, 'seeds 11-20, held out')):
        f = sets[name]['figures']
        cases = [f[f'case {case}'] for case in CASES]
        for what, key in (('odometry', 'odometry_ate_sim3_rmse_m'),
                          ('**sslcd**', 'ate_sim3_rmse_m'),
                          ('sslcd, largest error', 'ate_sim3_max_m'),
                          ('sslcd, after SE(3)', 'ate_se3_rmse_m')):
            rows.append([f'{what}, {title}'] + [number(c[key], 3) for c in cases] +
                        [number(mean(c[key] for c in cases), 3)])
    paper = list(PAPER_ATE.values())
    rows.append(['Ji et al., as printed, on their data'] + [number(v, 3) for v in paper] +
                [number(mean(paper), 3)])
    header = ['ATE after Sim(3), mean of RMSE [m]', '1 rectangle', '2 out and back', '3 curve',
              '4 small loop', 'mean']
    return table(header, rows) + note([sets[KNOWN], sets[FRESH]])


def halv_viewpoints(sets):
    rows = []
    for name, title in ((KNOWN, '1-10'), (FRESH, '11-20, held out')):
        for key in [f'{b} degrees' for b in BINS] + ['all']:
            f = sets[name]['figures'][key]
            rows.append([title, key.removesuffix(' degrees'), f['keyframes'], f['recognised'],
                         percent(f['recognised'] / f['keyframes']), f['loops'], f['wrong'],
                         number(f['error_median_m'], 3)])
    header = ['seeds', 'viewpoint change [degrees]', 'keyframes to recognise', 'recognised',
              'share', 'loops accepted', 'wrong (5 m)', 'median error [m]']
    return table(header, rows) + note([sets[KNOWN], sets[FRESH]])


def sum_pairs(entries):
    def total(key):
        return sum(entry['figures'][scene][key] for entry in entries for scene in SCENES)
    return f'{total("right")} / {total("wrong")} / {total("refused")} of {total("pairs")}'


def sum_loops(figures):
    figures = list(figures)
    wrong = sum(f['loops_wrong'] for f in figures)
    opposite = sum(f['loops_true_135-180_deg'] for f in figures)
    found = sum(f['revisits_recognised'] * f['revisited_stretches'] for f in figures)
    return (f'{sum(f["loops"] for f in figures)}, {wrong} wrong; {opposite} from 135-180 degrees; '
            f'{percent(found / sum(f["revisited_stretches"] for f in figures))} of revisits')


def summary(sets):
    """The five figures of the README, on development data and on held-out data."""
    def halv(name):
        f = sets[name]['figures']
        cases = [f[f'case {case}'] for case in CASES]
        error = arrow(mean(c['odometry_ate_sim3_rmse_m'] for c in cases),
                      mean(c['ate_sim3_rmse_m'] for c in cases))
        everything = f['all']
        loops_text = (f'{everything["loops"]}, {everything["wrong"]} wrong; '
                      f'{f["135-180 degrees"]["loops"]} from 135-180 degrees; '
                      f'{percent(everything["recognised"] / everything["keyframes"])} of revisits')
        return f'{error} m', loops_text

    def real(of_role, semi_real):
        return sum_loops(e['figures'] for n, e in sets.items() if n.startswith('loops/')
                         and e['role'] == of_role and ('poles' in n) == semi_real)

    def matching(of_role):
        return sum_pairs([e for n, e in sets.items()
                          if n.startswith('pairs/') and e['role'] == of_role])

    stereo = [e['figures'] for n, e in sorted(sets.items()) if n.startswith(STEREO)
              if e['figures'].get('iou_map') is not None]
    iou = arrow(mean(f['iou_raw'] for f in stereo), mean(f['iou_map'] for f in stereo), 3)
    known, fresh = halv(KNOWN), halv(FRESH)
    rows = [
        ['Simulated car park: trajectory error (ATE), odometry -> sslcd', known[0], fresh[0]],
        ['Simulated car park: loops accepted', known[1], fresh[1]],
        ['Real detections: loops accepted (Victoria Park; held out: two forests)',
         real('development', False), real('held-out', False)],
        ['Simulated pairs of maps: places found without a prior pose, right / wrong / refused',
         matching('development'), matching('held-out')],
        ['KITTI tracking: 3D IoU of detections (stereo grade, noise simulated) -> of the map', iou,
         'no held-out data'],
    ]
    return table(['', 'data that options were chosen on', 'held-out data'], rows)


def bench(set_name, key, sets):
    """A table of `sslcd_run bench`."""
    entry = sets[set_name]
    written = entry['figures'][key]
    rows = [[cell or '-' for cell in row] for row in written['rows']]
    text = f'**{written["title"]}**\n\n' + table(written['header'], rows)
    return text + note([entry], BENCH[set_name])


TABLES = {f.__name__: f for f in (summary, kitti_scale, loops, kitti_ate, kitti_map, pairs, city,
                                  sessions, sessions_halv, relocalise, relocalise_halv,
                                  retrieval, retrieval_size, retrieval_real,
                                  change, change_still, fleet, fleet_merge, fleet_stages, stream, halv_ate,
                                  halv_viewpoints, properties, soak, worlds, worlds_worst)}
for bench_key in ('table1', 'table2', 'table3', 'attempts', 'attempts_churn',
                  'attempts_layout_very_important_3_cuboids', 'pr', 'viewpoint', 'ablation'):
    TABLES['bench_' + bench_key] = functools.partial(bench, 'bench/all', bench_key)
TABLES['bench_viewpoint_images'] = functools.partial(bench, 'bench/images', 'viewpoint_images')
