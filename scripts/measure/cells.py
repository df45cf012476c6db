# SPDX-License-Identifier: BSD-3-Clause
"""Rows and cells of the documents' tables, as Markdown."""

LOOPS = {'loops/victoria-park': 'Victoria Park', 'loops/kitti-odometry-poles/00': 'poles 00',
         'loops/kitti-odometry-poles/02': 'poles 02', 'loops/kitti-odometry-poles/05': 'poles 05',
         'loops/forest-evo-fwd': 'forest Evo', 'loops/forest-venman3-fwd': 'forest Venman'}


def table(header, rows):
    lines = [header, ['---'] * len(header), *rows]
    return ''.join('| ' + ' | '.join(str(cell) for cell in line) + ' |\n' for line in lines)


def number(value, digits=2):
    return '-' if value is None else f'{value:.{digits}f}'


def percent(value):
    return '-' if value is None else f'{100 * value:.1f} %'


def arrow(before, after, digits=2):
    return '-' if after is None else f'{number(before, digits)} -> {number(after, digits)}'


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def note(entries, command='scripts/measure.sh'):
    """The commit and date of the figures of a table."""
    commits = sorted({f'{entry["commit"]}, {entry["date"]}' for entry in entries})
    return '\nCommit ' + '; '.join(commits) + f': `{command}`.\n'


def role(entry):
    return {'development': 'yes', 'held-out': 'no'}[entry['role']]
