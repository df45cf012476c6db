# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/scale.md about retrieval."""
from cells import LOOPS, note, number, percent, table

COMMAND = 'scripts/measure.sh --only retrieval'
KINDS = {'lot': 'car park', 'same': 'car park, cars only', 'street': 'street', 'trees': 'trees'}
NOISES = ['low', 'usual', 'high']
MAIN = 'retrieval/10000 sites'


def generated(sets):
    names = [name for name in sets if name.startswith('retrieval/') and name.endswith(' sites')]
    return sorted(names, key=lambda name: sets[name]['figures']['file']['sites'])


def retrieval(sets):
    figures = sets[MAIN]['figures']
    rows = []
    for kind, title in KINDS.items():
        for noise in NOISES:
            f = figures[f'{kind} {noise}']
            queries = f['queries']
            rows.append([title, noise, f['objects'], percent(f['ten'] / queries),
                         percent(f['first'] / queries), percent(f['oracle'] / queries),
                         number(f['median_ms'], 0), number(f['p95_ms'], 0)])
    header = ['site', 'noise', 'objects of a stretch', 'among the first ten', 'first',
              'true pose scores best', 'CPU, median [ms]', 'CPU, p95 [ms]']
    return table(header, rows) + note([sets[MAIN]], COMMAND)


def retrieval_size(sets):
    rows = []
    for name in generated(sets):
        f = sets[name]['figures']
        kinds = [f[f'{kind} usual'] for kind in KINDS if f'{kind} usual' in f]
        useful = [f[f'{kind} usual'] for kind in KINDS if kind != 'same']
        found = sum(k['ten'] for k in useful) / sum(k['queries'] for k in useful)
        rows.append([f'{f["file"]["sites"]:.0f}', f'{f["file"]["objects"]:.0f}',
                     number(f['file']['bytes_an_object'], 0), number(f['file']['build_s'], 1),
                     number(f['file']['open_s']), percent(found),
                     number(max(k['median_ms'] for k in kinds), 0),
                     number(max(k['p95_ms'] for k in kinds), 0)])
    header = ['sites', 'objects', 'bytes an object', 'build, CPU [s]', 'open and check, CPU [s]',
              'among the first ten', 'CPU of a query, median of the slowest kind [ms]',
              'p95 of the slowest kind [ms]']
    return table(header, rows) + note([sets[name] for name in generated(sets)], COMMAND)


def retrieval_real(sets):
    entry = sets['retrieval/real']
    rows = []
    for name, f in entry['figures'].items():
        rows.append([LOOPS['loops/' + name], f'{f["landmarks"]:.0f}', f'{f["objects"]:.0f}',
                     f'{f["stretches"]:.0f}', f'{f["ten"]:.0f}', f'{f["first"]:.0f}',
                     number(f['p95_ms'], 0)])
    header = ['drive', 'landmarks of its map', 'objects of a stretch',
              'stretches that share six landmarks', 'among the first ten', 'first',
              'CPU, p95 [ms]']
    return table(header, rows) + note([entry], COMMAND)
