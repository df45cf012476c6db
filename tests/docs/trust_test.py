# SPDX-License-Identifier: BSD-3-Clause
"""scripts/measure/trust.py and sensitivity.py: what counts as right, harmed, off and sensitive."""
import math
import os
import sys
import tempfile
import unittest
from pathlib import Path

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, '../../scripts/measure'))
try:
    import judged_runs
    import sensitivity
    import trust
except ImportError as missing:
    if missing.name != 'numpy':
        raise
    print('skipped: python3 with numpy is not installed')
    sys.exit(77)


def result(name='w', seed=1, loops=10, wrong=0, recall=1., stretches=10, ate=1., odometry=2.):
    return {'name': name, 'seed': seed, 'loops': loops, 'wrong_loops': wrong, 'recall': recall,
            'revisited_stretches': stretches, 'ate': ate, 'ate_odometry': odometry,
            'horizontal': 1., 'horizontal_odometry': 1., 'height': 1., 'height_odometry': 1.,
            'squared_errors': []}


def attempts(score, count, right, accepted=0):
    return [{'score': score, 'probability': 1 / (1 + math.exp(-score)), 'accepted': i < accepted,
             'right': i < right} for i in range(count)]


class Judging(unittest.TestCase):
    LOOPS = ('query_frame,match_frame,decision,score,probability,tx,ty,tz,qx,qy,qz,qw\n'
             '1,0,{},3,{},{},{},{},0,{},0,{}\n')

    def right(self, x=0., y=0., z=2., degrees=0., decision='accepted', probability='0.95'):
        """Of a camera that has gone 2 m ahead."""
        half = math.radians(degrees) / 2
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / 'groundtruth.txt').write_text(
                '0 0 0 0 0 0 0 1\n1 0 0 2 0 0 0 1\n', encoding='utf-8')
            (Path(folder) / 'loops.csv').write_text(
                self.LOOPS.format(decision, probability, x, y, z, math.sin(half), math.cos(half)),
                encoding='utf-8')
            rows = judged_runs.read_attempts(Path(folder), Path(folder))
        return [row['right'] for row in rows]

    def test_the_true_pose_is_right(self):
        self.assertEqual(self.right(), [True])

    def test_five_metres_five_degrees_and_a_storey_are_wrong(self):
        self.assertEqual(self.right(x=4.9), [True])
        self.assertEqual(self.right(x=5.1), [False])
        self.assertEqual(self.right(x=4, z=5.1), [False])  # 5.06 m in the level
        self.assertEqual(self.right(degrees=4.9), [True])
        self.assertEqual(self.right(degrees=-5.1), [False])
        self.assertEqual(self.right(y=1.4, x=4.5), [True])
        self.assertEqual(self.right(y=-1.6), [False])

    def test_scores_that_are_no_log_odds_do_not_count(self):
        self.assertEqual(self.right(probability=''), [])

    def test_squared_errors_are_those_of_loops_in_their_sigmas(self):
        information = '4 0 0 0 0 0  1 0 0 0 0  1 0 0 0  100 0 0  100 0  100'
        edges = [f'EDGE_SE3:QUAT 0 1 0 0 9 0 0 0 1 {information}',  # odometry
                 f'EDGE_SE3:QUAT 0 2 .5 0 4 {math.sin(.1)} 0 0 {math.cos(.1)} {information}']
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / 'groundtruth.txt').write_text(
                '0 0 0 0 0 0 0 1\n1 0 0 2 0 0 0 1\n2 0 0 4 0 0 0 1\n', encoding='utf-8')
            (Path(folder) / 'graph.g2o').write_text(
                '\n'.join(['VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1', *edges, '']), encoding='utf-8')
            squared = judged_runs.squared_errors_of_loops(Path(folder), Path(folder))
        self.assertEqual(len(squared), 1)
        # -.5 m seen from a camera turned by .2 about x stays -.5; .2 rad at .1 rad
        self.assertAlmostEqual(squared[0], 4 * .5**2 + 100 * .2**2)

    def test_worlds_are_chosen_by_patterns(self):
        self.assertTrue(judged_runs.is_wanted('b2_d60', 'h_*,b2_*'))
        self.assertFalse(judged_runs.is_wanted('b_copy_d60', 'h_*,b2_*'))


class Trust(unittest.TestCase):
    def test_two_percent_and_two_centimetres_are_no_harm(self):
        self.assertFalse(trust.is_harmed(result(ate=2.059)))
        self.assertTrue(trust.is_harmed(result(ate=2.061)))
        self.assertFalse(trust.is_harmed(result(ate=0.02, odometry=0.)))

    def test_height_and_horizontal_position_may_be_harmed_alone(self):
        for part in ('horizontal', 'height'):
            self.assertTrue(trust.is_harmed({**result(), part: 1.05}))

    def test_recall_is_over_all_stretches(self):
        self.assertAlmostEqual(trust.recall_of([result(recall=1., stretches=1),
                                                result(recall=.5, stretches=9)]), .55)
        self.assertIsNone(trust.recall_of([result(stretches=0)]))

    def test_covariances_are_off_below_4_and_above_9(self):
        self.assertEqual(trust.cell_of_squared_errors([6.] * 30), '6.0')
        self.assertEqual(trust.cell_of_squared_errors([3.9] * 30), '3.9 off')
        self.assertEqual(trust.cell_of_squared_errors([9.1] * 30), '9.1 off')
        self.assertEqual(trust.cell_of_squared_errors([9.1] * 29), '9.1')

    def test_runs_of_a_world_share_a_row(self):
        rows = trust.table_of_runs([result(), result(seed=2, wrong=3, recall=.5, ate=2.5),
                                    result('v', stretches=0)])
        self.assertEqual(rows[2:], ['| w | 2 | 20 | 3 | 0.75 | 2.00 -> 1.00, 2.00 -> 2.50 | 1 | - |',
                                    '| v | 1 | 10 | 0 | - | 2.00 -> 1.00 | 0 | - |'])

    def test_a_bin_is_off_by_more_than_ten_points(self):
        def row(*some):
            return trust.table_of_scores(attempts(*some))[2:]
        self.assertEqual(row(2.5, 40, 36, 3), ['| 2 to 3 | 40 | 0.924 | 0.900 | 3 |  |'])
        self.assertEqual(row(2.5, 40, 32), ['| 2 to 3 | 40 | 0.924 | 0.800 | 0 | off |'])
        self.assertEqual(row(2.5, 29, 0), ['| 2 to 3 | 29 | 0.924 | 0.000 | 0 |  |'])
        self.assertEqual(row(-1, 30, 30), ['| -inf to 0 | 30 | 0.269 | 1.000 | 0 | off |'])

    def test_a_score_between_two_bins_is_in_the_upper_one(self):
        rows = trust.table_of_scores(attempts(3., 1, 1) + attempts(2.99, 2, 2))
        self.assertEqual([row.split(' | ')[:2] for row in rows[2:]],
                         [['| 2 to 3', '2'], ['| 3 to 5', '1']])


MARKDOWN = '''## Everyday
| `loop.tracks.look_alike` | 0.5 | 0 .. 1 | meaning | effect |
## All keys
| `mode` | name | robust | robust, paper | meaning |

## `loop`
| `enabled` | flag | true | true, false | meaning |
| `sigma_m` | number | 0.05 | 0 .. 100 | meaning |

## `loop.match.search`
| `min_matches` | integer | 4 | 3 .. 1000 | meaning |
'''


class Sensitivity(unittest.TestCase):
    SIGMA = sensitivity.Option('loop.sigma_m', .05, 0., 100., False)
    DEFAULT = sensitivity.Figures(100, 1, .8, 2.)

    def test_options_are_the_programs_numbers(self):
        self.assertEqual(sensitivity.parse_options(MARKDOWN),
                         [self.SIGMA, ('loop.match.search.min_matches', 4., 3., 1000., True)])

    def test_values_stay_in_their_range(self):
        def others(*option):
            return sensitivity.other_values(sensitivity.Option('key', *option))
        self.assertEqual(others(.05, 0., 100., False), ['0.025', '0.1'])
        self.assertEqual(others(4., 3., 1000., True), ['3', '8'])
        self.assertEqual(others(3., 1., 1000., True), ['1', '6'])
        self.assertEqual(others(.9, .5, .9, False), ['0.5'])
        self.assertEqual(others(0., 0., 1., False), [])

    def test_a_tenth_of_the_loops_or_one_wrong_loop(self):
        def sensitive(loops, wrong, path=1.):
            return sensitivity.is_sensitive(self.DEFAULT,
                                            sensitivity.Figures(loops, wrong, 0., 9.), path)
        self.assertFalse(sensitive(90, 1))
        self.assertTrue(sensitive(89, 1))
        self.assertTrue(sensitive(100, 2))
        self.assertFalse(sensitive(45, 0, 2.))
        self.assertTrue(sensitive(179, 0, .5))

    def test_loops_are_fewer_where_attempts_are(self):
        every = sensitivity.Option('loop.layout.every_m', 5., .1, 1000., False)
        self.assertEqual(sensitivity.path_per_loop(every, '10'), 2.)
        self.assertEqual(sensitivity.path_per_loop(self.SIGMA, '0.1'), 1.)

    def test_worlds_count_together(self):
        sets = sensitivity.by_set([result('a', 1, 10, 0, 1., 5, 1.),
                                   result('b', 2, 20, 1, .5, 5, 2.), result('real', 0, 7)])
        self.assertEqual(sets, {'worlds': (30, 1, .75, 1.5), 'real': (7, 0, 1., 1.)})

    def test_a_run_that_fails_is_marked(self):
        failed = sensitivity.by_set([{'name': 'real', 'seed': 0, 'error': 'refused'}])
        self.assertEqual(failed, {'real': None})
        self.assertEqual(sensitivity.row_of(self.SIGMA, '0.1', {'real': self.DEFAULT}, failed),
                         ('| `loop.sigma_m` | 0.1 | **failed** |', True))

    def test_rows_are_relative_to_the_defaults(self):
        default = {'a': self.DEFAULT, 'b': sensitivity.Figures(0, 0, None, 0.)}
        changed = {'a': sensitivity.Figures(97, 0, .81, 2.2), 'b': default['b']}
        row, marked = sensitivity.row_of(self.SIGMA, '0.1', default, changed)
        self.assertEqual(row, '| `loop.sigma_m` | 0.1 | -3 %, -1, +0.01, x1.10 | -, +0, -, - |')
        self.assertFalse(marked)
        changed['a'] = sensitivity.Figures(100, 2, .8, 2.)
        row, marked = sensitivity.row_of(self.SIGMA, '0.1', default, changed)
        self.assertIn('| **+0 %, +1, +0.00, x1.00** |', row)
        self.assertTrue(marked)
        self.assertEqual(sensitivity.head_of_table(default)[2:],
                         ['| option | value | a | b |', '|---|---|---|---|',
                          '| defaults | | 100 loops, 1 wrong, 0.80, 2.00 m | '
                          '0 loops, 0 wrong, -, 0.00 m |'])


if __name__ == '__main__':
    unittest.main()
