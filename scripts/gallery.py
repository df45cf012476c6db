#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/gallery.md and docs/images/gallery: simulated drives, mapped and drawn.
usage: scripts/gallery.py [BUILD]     BUILD: where sslcd_run and sslcd_sim were built (build/release)"""
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..')
SEED = 5
DRIVES = [  # name, title, what to look at, arguments of sslcd_sim
    ('rectangle', 'Round a car park',
     'The camera comes back along its first lane, in the opposite direction.', ['--case', '1']),
    ('out_and_back', 'Out and back',
     'A street, and the way back on it.',
     ['--case', '2', '--layout', 'street']),
    ('curve', 'A curve', 'A curved lane, and the way back on it.', ['--case', '3']),
    ('churn', 'Other cars',
     'As the first drive, but three of ten cars were replaced before the camera came back.',
     ['--case', '1', '--churn', '0.3']),
]
HEAD = """# Gallery

Simulated drives ([HALV-sim](halv_sim.md), seed {seed}), mapped with the default options. On the left
the odometry and the loops as it has them, on the right the corrected trajectory with the objects.
`scripts/gallery.py` writes this page. A picture of your own run: `sslcd_run draw RUN --before-after`;
the same in 3D, with a replay: [reports](report.md).
"""
DRIVE = """
## {title}
{text}
{loops} loops, {wrong} wrong. Trajectory error (ATE): {before:.2f} m before, {after:.2f} m after.

![{title}: odometry with loops, corrected trajectory with objects](images/gallery/{name}.svg)
```
sslcd_sim halv {arguments} --seed {seed} --out DRIVE
sslcd_run run DRIVE --groundtruth groundtruth.txt --out RUN
sslcd_run draw RUN --before-after --out {name}.svg
```
"""


def program(build, name, *arguments):
    subprocess.run([os.path.join(build, 'apps', name), *arguments], check=True,
                   stdout=subprocess.DEVNULL)


def map_and_draw(build, name, arguments):
    """The metrics of the run."""
    picture = os.path.join(ROOT, 'docs/images/gallery', name + '.svg')
    with tempfile.TemporaryDirectory() as folder:
        drive, run = os.path.join(folder, 'drive'), os.path.join(folder, 'run')
        program(build, 'sslcd_sim', 'halv', *arguments, '--seed', str(SEED), '--out', drive)
        program(build, 'sslcd_run', 'run', drive, '--groundtruth', 'groundtruth.txt', '--out', run,
                '--quiet')
        program(build, 'sslcd_run', 'draw', run, '--before-after', '--size', '1000', '--out', picture)
        with open(os.path.join(run, 'metrics.json'), encoding='utf-8') as file:
            return json.load(file)


def main():
    build = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, 'build/release')
    os.makedirs(os.path.join(ROOT, 'docs/images/gallery'), exist_ok=True)
    page = HEAD.format(seed=SEED)
    for name, title, text, arguments in DRIVES:
        metrics = map_and_draw(build, name, arguments)
        page += DRIVE.format(name=name, title=title, text=text, arguments=' '.join(arguments),
                             seed=SEED, loops=metrics['loops'], wrong=metrics['loops_wrong'],
                             before=metrics['odometry_ate_se3_rmse_m'],
                             after=metrics['ate_se3_rmse_m'])
    with open(os.path.join(ROOT, 'docs/gallery.md'), 'w', encoding='utf-8') as file:
        file.write(page)


if __name__ == '__main__':
    main()
