# SPDX-License-Identifier: BSD-3-Clause
"""The commands into whose calls scripts/fault_test.py puts faults. They run in a folder with data/ (a sequence),
wrong/ (one with a mistake), stereo/ (images), pairs.txt and loops.g2o."""
import dataclasses
import os
import shutil
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, '../cli'))
from mistakes import MISTAKES  # noqa: E402
from sequence_numbers import Sequence  # noqa: E402
from stereo_world import write_drive  # noqa: E402

DATA = os.path.join(HERE, '../data')


@dataclasses.dataclass
class Command:
    name: str
    words: str  # of the command that is made to fail
    before: tuple = ()  # commands that make what is there before; 'KILL write:N ...' is killed at its N-th writing call
    out: str = 'out'  # what it writes: a folder, a file, or a map (.db)
    replaces: bool = True  # what is there; otherwise that is removed before it is run again


def _run(frames, out='--out out --force', more=''):
    return f'run data --max-frames {frames} {out} --quiet --no-check {more}'


ALL = [
    Command('run', _run(20), (_run(17),)),
    Command('run into nothing', _run(20)),
    Command('run --report', _run(20, more='--report'), (_run(17, more='--report'),)),
    Command('run --map', _run(20, '--map out.db'), out='out.db'),
    Command('run --map, second', _run(20, '--map out.db', '--session second'), (_run(17, '--map out.db', '--session first'),),
            out='out.db'),
    Command('run --resume', _run(20, '--map out.db', '--resume'), ('KILL write:90 ' + _run(20, '--map out.db'),), out='out.db'),
    Command('map compact', 'map compact out.db -q', (_run(17, '--map out.db'),), out='out.db'),
    Command('map end', 'map end out.db -q', ('KILL write:90 ' + _run(20, '--map out.db'),), out='out.db'),
    Command('map export', 'map export site.db --out out -q',
            (_run(17, '--map site.db', '--session first'), 'map export site.db --out out -q',
             _run(20, '--map site.db', '--session second'))),
    Command('detect', 'detect stereo --boxes stereo/boxes.txt --out out --force --no-check --threads 1',
            ('detect stereo --boxes stereo/boxes.txt --out out --max-frames 2 -q --no-check',)),
    Command('detect --overlays', 'detect stereo --boxes stereo/boxes.txt --out out --overlays --force --no-check --threads 1'),
    Command('check --fix', 'check wrong --fix out -q', replaces=False),
    Command('match', 'match pairs.txt --out out.csv -q', ('match pairs.txt --out out.csv --mode paper -q',), 'out.csv'),
    Command('graph', 'graph loops.g2o --out out.g2o -q', ('graph loops.g2o --out out.g2o --robust -q',), 'out.g2o'),
    Command('export', 'export run --out out.glb', (_run(17, '--out run'), 'export run --out out.glb', _run(20, '--out run --force')),
            'out.glb'),
    Command('draw', 'draw run --out out.svg', (_run(17, '--out run'), 'draw run --out out.svg', _run(20, '--out run --force')),
            'out.svg'),
    Command('report', 'report run --out out.html',
            (_run(17, '--out run'), 'report run --out out.html', _run(20, '--out run --force')), 'out.html'),
    Command('relocalise', 'relocalise data --map site.db --frames 15 --out out.csv -q', (_run(20, '--map site.db'),), 'out.csv'),
    Command('sites index', 'sites index site.db --out out.sites', (_run(20, '--map site.db'),), 'out.sites'),
    Command('bench', 'bench table2 --seeds 1 --cases 1 --methods paper --threads 1 --out out -q'),
]


def commands(names=None):
    """All of them, or those that are named."""
    known = {command.name: command for command in ALL}
    unknown = set(names or ()) - set(known)
    if unknown:
        sys.exit(f'no command {", ".join(sorted(unknown))}; known are {", ".join(known)}')
    return [known[name] for name in names] if names else ALL


def write_inputs(folder, words):
    """Those that occur in `words`."""
    shutil.copytree(DATA + '/sim_rectangle', folder + '/data')
    if 'wrong' in words:
        sequence = Sequence(folder + '/data')
        MISTAKES['centre'][1](sequence)
        sequence.write(folder + '/wrong')
    if 'stereo' in words:
        write_drive(folder + '/stereo', 3)
    shutil.copy(DATA + '/object_pairs.txt', folder + '/pairs.txt')
    shutil.copy(DATA + '/loops.g2o', folder + '/loops.g2o')
