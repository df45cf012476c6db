# SPDX-License-Identifier: BSD-3-Clause
"""The tables of several sessions on one map: joined, found again, changed."""
from cells import LOOPS, note, number, percent, role, table


def sessions(sets):
    entries = {name: sets['sessions/' + name.removeprefix('loops/')] for name in LOOPS
               if 'sessions/' + name.removeprefix('loops/') in sets}
    orders = [order for order in next(iter(entries.values()))['figures'] if order != '1']
    rows = []
    for name, entry in entries.items():
        f = entry['figures']
        whole = f['1']
        ate = [f'{number(f[order]["ATE_m"])} ({number(f[order]["horizontal_m"])})'
               for order in orders]
        joined = [f[order]['frames'] == whole['frames'] for order in orders]
        rows.append([LOOPS[name], role(entry),
                     f'{number(whole["ATE_m"])} ({number(whole["horizontal_m"])})', *ate,
                     ', '.join('all' if one else 'some' for one in joined),
                     sum(round(f[order]['wrong']) for order in orders)])
    header = ['drive', 'chosen on it', 'whole: ATE (horizontal) [m]',
              *(f'order {order}' for order in orders), 'joined', 'wrong loops, three orders']
    return table(header, rows) + note(entries.values(), 'scripts/measure.sh --only sessions')


def sessions_halv(sets):
    entries = {title: sets['sessions/HALV-sim ' + which]
               for which, title in (('halv', 'site'), ('copy', 'site, then its copy'))
               if 'sessions/HALV-sim ' + which in sets}
    rows = [[title, f['sessions'], f'{f["near"]} ({percent(f["near"] / f["sessions"])})',
             f['wrong'], f['to_copy']]
            for title, f in ((title, entry['figures']) for title, entry in entries.items())]
    header = ['in the map', 'sessions', 'a loop within 50 m', 'with a wrong loop',
              'with a loop to or from the copy']
    return table(header, rows) + note(entries.values(), 'scripts/measure.sh --only sessions')


def change(sets):
    rows = []
    for churn in ('0.3', '0.6'):
        entry = sets.get(f'change/HALV-sim {churn}')
        layouts = dict(entry['figures']) if entry else {}
        if layouts:
            layouts['both'] = {key: sum(f[key] for f in layouts.values())
                               for key in next(iter(layouts.values()))}
        for layout, f in layouts.items():
            row = [percent(float(churn)), layout, f'{f["joined"]} of {f["maps"]}']
            for what in ('departures', 'arrivals'):
                found, wrong = f[f'{what}_found'], f[f'wrong_{what}']
                row += [f[what], number(found / (found + wrong), 3), number(found / f[what], 3)]
            rows.append(row)
    header = ['replaced', 'layout', 'maps with all sessions joined', 'departures', 'precision',
              'recall', 'arrivals', 'precision', 'recall']
    entries = [entry for name, entry in sets.items() if name.startswith('change/HALV-sim')]
    return table(header, rows) + note(entries, 'scripts/measure.sh --only change')


def change_still(sets):
    entries = {name: sets['change/' + name.removeprefix('loops/')] for name in LOOPS
               if 'change/' + name.removeprefix('loops/') in sets}
    rows = [[LOOPS[name], role(entry), entry['figures']['places'], entry['figures']['in_view_twice'],
             entry['figures']['departures'], entry['figures']['arrivals']]
            for name, entry in entries.items()]
    header = ['drive', 'chosen on it', 'places', 'in view of two successive sessions',
              'false departures', 'false arrivals']
    return table(header, rows) + note(entries.values(), 'scripts/measure.sh --only change')


def relocalise(sets):
    entries = {name: sets['relocalise/' + name.removeprefix('loops/')] for name in LOOPS
               if 'relocalise/' + name.removeprefix('loops/') in sets}
    rows = []
    for name, entry in entries.items():
        f = entry['figures']
        rows.append([LOOPS[name], role(entry), round(f['landmarks']),
                     f'{f["found"]:.0f} of {f["sharing"]:.0f}',
                     f'{f["found_elsewhere"]:.0f} of {f["elsewhere"]:.0f}', round(f['wrong']),
                     number(f['path_m'], 0), number(f['error_m']), number(f['p95_ms'], 1)])
    header = ['drive', 'chosen on it', 'landmarks', 'stretches in the map: found',
              'stretches elsewhere: found', 'wrong answers', 'path to the answer, median [m]',
              'its error, median [m]', 'an attempt, p95 [ms]']
    return table(header, rows) + note(entries.values(), 'scripts/measure.sh --only relocalise')


def relocalise_halv(sets):
    entries = {(title, churn): sets[f'relocalise/HALV-sim {which} {churn}']
               for which, title, churn in (('halv', 'site', '0.3'), ('halv', 'site', '0.6'),
                                           ('copy', 'site and its copy', '0.3'))
               if f'relocalise/HALV-sim {which} {churn}' in sets}
    rows = []
    for (title, churn), entry in entries.items():
        f = entry['figures']
        rows.append([title, percent(float(churn)), f['sessions'], f['found'],
                     f'{f["near"]} ({percent(f["near"] / f["sessions"])})', f['wrong']])
    header = ['in the map', 'cars replaced', 'sessions', 'found', 'found within 50 m',
              'with a wrong answer']
    return table(header, rows) + note(entries.values(), 'scripts/measure.sh --only relocalise')
