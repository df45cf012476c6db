# SPDX-License-Identifier: BSD-3-Clause
"""scripts/measure: what counts as right, what is measured again, what goes into the documents."""
import json
import math
import os
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, '../../scripts/measure'))
import bench  # noqa: E402
import documents  # noqa: E402
import halv  # noqa: E402
import measure  # noqa: E402
import pairs  # noqa: E402
import runs  # noqa: E402
import store  # noqa: E402
import tables  # noqa: E402

PAIRS = '''# comment
PAIR 0 street/n0.1 2 2 0.5 10 20 0
L 1 0 1 2 0
L 2 0 3 4 0
PAIR 1 lot/absent 1 1 0 0 0 0
L 1 0 1 2 0
'''
HEADER = 'pair,decision,yaw_rad,tx,ty,tz,score,second_score,matches,ms\n'


def count(rows, text=PAIRS):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'pairs.txt')
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)
        return pairs.count_answers(pairs.read_truth(path), HEADER + rows)


def verdict(row, scene='street'):
    counts = count(row)[scene]
    return [name for name in ('right', 'wrong', 'refused') if counts[name] == 1]


class AnswersToPairs(unittest.TestCase):
    def test_true_pose_is_right(self):
        self.assertEqual(verdict('0,accepted,0.5,10,20,0,9,1,4,0.1\n'), ['right'])

    def test_a_turn_more_is_the_same_heading(self):
        self.assertEqual(verdict(f'0,accepted,{0.5 - 2 * math.pi},10,20,0,9,1,4,0.1\n'), ['right'])

    def test_a_metre_off_is_wrong(self):
        self.assertEqual(verdict('0,accepted,0.5,10,21.01,0,9,1,4,0.1\n'), ['wrong'])
        self.assertEqual(verdict('0,accepted,0.5,10,20.99,0,9,1,4,0.1\n'), ['right'])

    def test_six_degrees_about_the_local_map_are_wrong(self):
        pair = {'absent': False, 'points': [(0, 0)], 'yaw': 0., 'x': 0., 'y': 0.}
        self.assertFalse(pairs.is_right(pair, math.radians(6), 0, 0))
        self.assertTrue(pairs.is_right(pair, math.radians(4), 0, 0))

    def test_position_is_that_of_the_local_map_not_of_its_origin(self):
        pair = {'absent': False, 'points': [(100, 0)], 'yaw': 0., 'x': 0., 'y': 0.}
        self.assertFalse(pairs.is_right(pair, math.radians(2), 0, 0))  # 3.5 m off at the objects

    def test_an_answer_to_an_absent_place_is_wrong(self):
        self.assertEqual(verdict('1,accepted,0,0,0,0,9,1,4,0.1\n', 'lot'), ['wrong'])

    def test_answers_with_a_score_of_five_are_sure(self):
        there = count('0,accepted,0.5,10,20,0,5,1,4,0.1\n')['street']
        self.assertEqual((there['right_sure'], there['wrong_sure']), (1, 0))
        self.assertEqual(count('0,accepted,0.5,10,20,0,4.9,1,4,0.1\n')['street']['right_sure'], 0)
        self.assertEqual(count('1,accepted,0,0,0,0,5,1,4,0.1\n')['lot']['wrong_sure'], 1)

    def test_what_is_not_accepted_is_refused(self):
        self.assertEqual(verdict('0,ambiguous,0.5,10,20,0,9,1,4,0.1\n'), ['refused'])
        self.assertEqual(verdict('0,none,0,0,0,0,0,0,0,0.1\n'), ['refused'])


def loop(at_m, error_m=0.1, accepted=True, degrees=170):
    return {'at_m': at_m, 'error_m': error_m, 'accepted': accepted,
            'viewpoint_rad': math.radians(degrees)}


class HalvTrials(unittest.TestCase):
    def figures(self, loops, revisit_at_m=100., degrees=170):
        revisit = {'at_m': revisit_at_m, 'viewpoint_rad': math.radians(degrees)}
        return halv.viewpoint_figures([{'revisits': [revisit], 'loops': loops}], (135, 180))

    def test_a_right_loop_near_the_keyframe_recognises_it(self):
        self.assertEqual(self.figures([loop(104)])['recognised'], 1)

    def test_a_far_a_wrong_and_a_refused_loop_do_not(self):
        self.assertEqual(self.figures([loop(106), loop(100, 5.), loop(100, accepted=False)]),
                         {'keyframes': 1, 'recognised': 0, 'loops': 2, 'wrong': 1,
                          'error_median_m': 0.1})

    def test_bins_hold_their_lower_end_and_the_last_one_its_upper_end_too(self):
        self.assertEqual(self.figures([], degrees=134.9)['keyframes'], 0)
        self.assertEqual(self.figures([], degrees=135.1)['keyframes'], 1)
        self.assertTrue(halv.in_bin(math.pi, (135, 180)))
        self.assertFalse(halv.in_bin(math.radians(45.), (0, 45)))


class BenchTables(unittest.TestCase):
    def test_a_table_goes_through_the_json_as_it_was_printed(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (('pr.md', '**Title, 1**\n\n| a | b |\n'),
                               ('pr.csv', 'a,b\n0.500,"1, 2"\n,x\n')):
                with open(os.path.join(folder, name), 'w', encoding='utf-8') as file:
                    file.write(text)
            figures = {'pr': bench.read_table(folder, 'pr')}
        sets = {'bench/all': {'figures': figures, 'commit': 'abc', 'date': 'today'}}
        self.assertEqual(tables.TABLES['bench_pr'](sets),
                         '**Title, 1**\n\n| a | b |\n| --- | --- |\n| 0.500 | 1, 2 |\n| - | x |\n'
                         '\nCommit abc, today: `sslcd_run bench all`.\n')

    def test_images_that_are_not_there_are_missing(self):
        everything, images = bench.bench_sets('/nowhere')
        self.assertTrue(everything.missing.startswith('/nowhere/'))
        self.assertIn('SSLCD_BENCH_IMAGES', images.missing)


class FakeSet:
    """A set whose figures count how often it was measured."""
    name, role, missing = 'part/one', 'held-out', None

    def __init__(self):
        self.inputs, self.runs = 'a', 0

    def fingerprint(self):
        return self.inputs

    def measure(self, _):
        self.runs += 1
        return {'runs': self.runs}


class Resuming(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, 'figures.json')
        self.set = FakeSet()

    def measure(self, code='abc', force=False):
        return measure.measure_set(self.set, None, store.Store(self.path), code, force)

    def test_a_finished_set_is_kept(self):
        self.assertEqual(self.measure(), 'measured')
        self.assertEqual(self.measure(), 'kept')
        self.assertEqual(self.set.runs, 1)

    def test_other_inputs_other_code_or_force_measure_again(self):
        self.measure()
        self.set.inputs = 'b'
        self.assertEqual(self.measure(), 'measured')
        self.assertEqual(self.measure('abd'), 'measured')
        self.assertEqual(self.measure('abd', force=True), 'measured')
        with open(self.path, encoding='utf-8') as file:
            self.assertEqual(json.load(file)['sets']['part/one']['figures'], {'runs': 4})

    def test_code_that_is_in_no_commit_is_never_kept(self):
        self.measure('abc-dirty')
        self.assertEqual(self.measure('abc-dirty'), 'measured')

    def test_missing_data_is_named_and_leaves_what_is_known(self):
        self.measure()
        self.set.missing = 'DATA/one'
        self.assertEqual(self.measure(force=True), 'skipped: no DATA/one')
        self.assertEqual(store.Store(self.path).sets['part/one']['figures'], {'runs': 1})

    def test_contents_of_inputs_count(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'a.txt')
            prints = []
            for text in ('1', '1', '2'):
                with open(path, 'w', encoding='utf-8') as file:
                    file.write(text)
                prints.append(runs.fingerprint([folder], 'argument'))
            self.assertEqual(prints[0], prints[1])
            self.assertNotEqual(prints[0], prints[2])
            self.assertNotEqual(prints[2], runs.fingerprint([folder], 'other argument'))


class Documents(unittest.TestCase):
    def setUp(self):
        documents.TABLES['made_up'] = lambda sets: f'{sets}\n'
        self.addCleanup(documents.TABLES.pop, 'made_up')

    def test_the_table_stands_between_its_marks(self):
        text = 'a\n<!-- figures made_up -->\nold\n<!-- /figures -->\nb\n'
        new = documents.with_tables(text, 1)
        self.assertEqual(new, text.replace('old', '1'))
        self.assertEqual(documents.with_tables(new, 1), new)

    def test_unknown_tables_and_open_marks_are_errors(self):
        for text in ('<!-- figures none -->\n<!-- /figures -->\n', '<!-- figures made_up -->\n'):
            self.assertRaises(ValueError, documents.with_tables, text, 1)


if __name__ == '__main__':
    unittest.main()
