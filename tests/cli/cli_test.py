#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Good, bad and odd input through the real binary. usage: cli_test.py SSLCD_RUN SSLCD_SIM [unittest arguments]"""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

RUN, SIM = '', ''


def call(*args, **kwargs):
    return subprocess.run([RUN, *map(str, args)], capture_output=True, text=True, timeout=60, **kwargs)


def read(path):
    with open(path) as file:
        return file.read()


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w') as file:
        file.write(text)


class CliTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp(prefix='sslcd_cli_')
        cls.good = cls.root + '/good'
        subprocess.run([SIM, 'street', '--out', cls.good, '--seed', '7', '--frames', '40'], check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.root)

    def setUp(self):
        self.data = f'{self.root}/{self.id().split(".")[-1]}/data'
        self.out = f'{self.root}/{self.id().split(".")[-1]}/out'
        shutil.copytree(self.good, self.data)

    def tearDown(self):
        for folder, _, files in os.walk(self.root):
            for name in files:
                self.assertNotIn('.tmp-', name, f'half-written file in {folder}')

    def run_data(self, *args):
        return call('run', self.data, '--out', self.out, *args)

    def edit(self, name, change):
        """Applies `change` to the list of lines of a file."""
        lines = read(f'{self.data}/{name}').splitlines()
        lines = change(lines) or lines
        write(f'{self.data}/{name}', '\n'.join(lines) + '\n')

    def edit_field(self, name, row, column, value):
        def change(lines):
            fields = lines[row].split()
            fields[column] = value
            lines[row] = ' '.join(fields)
        self.edit(name, change)

    def refused(self, result, code, *messages):
        self.assertEqual(result.returncode, code, result.stderr)
        for message in messages:
            self.assertIn(message, result.stderr)
        self.assertFalse(os.path.exists(self.out + '/map.json'), 'a refused run must leave no result')

    # what works
    def test_good_run_writes_everything(self):
        result = self.run_data('--groundtruth', 'groundtruth.txt')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(self.out)), sorted([
            'trajectory_tum.txt', 'trajectory_kitti.txt', 'odometry_tum.txt', 'odometry_kitti.txt', 'map.json', 'map.ply',
            'graph.g2o', 'loops.csv', 'timing.json', 'metrics.json', 'config.yaml']))
        self.assertIn('(guessed)', result.stdout)
        self.assertIn('wrote ' + self.out + '/map.json', result.stdout)
        self.assertNotIn('\r', result.stdout + result.stderr, 'no progress line in a pipe')
        for name, columns in (('trajectory_tum.txt', 8), ('trajectory_kitti.txt', 12)):
            rows = read(f'{self.out}/{name}').split('\n')[:-1]
            self.assertEqual(len(rows), 40)
            for row in rows:
                self.assertEqual(len(row.split(' ')), columns, row)
        metrics = json.loads(read(self.out + '/metrics.json'))
        self.assertLess(metrics['ate_se3_rmse_m'], metrics['odometry_ate_se3_rmse_m'])
        self.assertGreater(sum(o['state'] == 'confirmed' for o in json.loads(read(self.out + '/map.json'))['objects']), 3)
        json.loads(read(self.out + '/timing.json'))
        again = call('eval', self.out, '--groundtruth', self.data + '/groundtruth.txt', '--json')
        self.assertAlmostEqual(json.loads(again.stdout)['ate_se3_rmse_m'], metrics['ate_se3_rmse_m'], places=6)
        self.assertEqual(call('check-config', self.out + '/config.yaml').returncode, 0)

    def test_same_bytes_every_time_and_for_any_thread_count(self):
        results = []
        for k, threads in enumerate((1, 1, 2)):
            out = f'{self.out}{k}'
            self.assertEqual(call('run', self.data, '--out', out, '--threads', threads).returncode, 0)
            results.append([read(f'{out}/{n}') for n in ('trajectory_tum.txt', 'map.json', 'graph.g2o', 'map.ply')])
        self.assertEqual(results[0], results[1])
        self.assertEqual(results[0], results[2])

    def test_quiet_and_json(self):
        quiet = self.run_data('--quiet')
        self.assertEqual((quiet.returncode, quiet.stdout, quiet.stderr), (0, '', ''))
        self.assertIn('ate_se3_rmse_m', json.loads(self.run_data('--json', '--groundtruth', 'groundtruth.txt').stdout))

    def test_paper_mode_and_max_frames(self):
        self.assertEqual(self.run_data('--mode', 'paper', '--max-frames', '20').returncode, 0)
        self.assertEqual(len(read(self.out + '/trajectory_tum.txt').splitlines()), 20)
        self.assertIn('mode: paper', read(self.out + '/config.yaml'))

    def test_empty_detections_run_and_say_so(self):
        write(self.data + '/detections.txt', '')
        result = self.run_data()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('no detections', result.stderr)
        self.assertEqual(read(self.out + '/trajectory_tum.txt'), read(self.out + '/odometry_tum.txt'))

    def test_frames_out_of_order_change_nothing(self):
        self.run_data()
        expected = read(self.out + '/trajectory_tum.txt')
        self.edit('detections.txt', lambda lines: sorted(lines, key=lambda l: -int(l.split()[0])))
        self.assertEqual(self.run_data().returncode, 0)
        rows = zip(expected.split(), read(self.out + '/trajectory_tum.txt').split())
        self.assertLess(max(abs(float(a) - float(b)) for a, b in rows), 1e-2)

    def test_unknown_labels_are_mapped_with_a_warning(self):
        self.edit('detections.txt', lambda lines: [l.replace('Car', 'Submarine') for l in lines])
        result = self.run_data()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('Submarine', result.stderr)

    def test_version(self):
        self.assertRegex(call('version').stdout, r'^sslcd \d+\.\d+\.\d+\n$')

    # files that are not there or not what they should be
    def test_missing_dataset(self):
        self.refused(call('run', self.root + '/nowhere', '--out', self.out), 3, 'nowhere')

    def test_missing_files(self):
        for name in ('odometry.txt', 'detections.txt'):
            shutil.move(f'{self.data}/{name}', f'{self.data}/away')
            self.refused(self.run_data('--format', 'sequence'), 3, name)
            shutil.move(f'{self.data}/away', f'{self.data}/{name}')
        self.refused(self.run_data('--detections', 'none.txt'), 3, 'none.txt')

    def test_missing_sequence_lists_what_is_there(self):
        tracking = self.data + '/tracking'
        write(tracking + '/calib/0007.txt', read(self.data + '/calib.txt'))
        write(tracking + '/label_02/0007.txt', '')
        result = call('run', tracking, '--format', 'kitti-tracking', '--sequence', '0008', '--out', self.out,
                      '--detections', 'x', '--odometry', 'y')
        self.assertIn(result.returncode, (2, 3))
        self.assertIn('0007', result.stderr)

    def test_a_folder_in_place_of_a_file(self):
        os.remove(self.data + '/odometry.txt')
        os.mkdir(self.data + '/odometry.txt')
        self.refused(self.run_data('--format', 'sequence'), 3, 'odometry.txt')

    # rows
    def test_bad_detection_rows(self):
        last = len(read(self.data + '/detections.txt').splitlines()[5].split()) - 1
        for change in (lambda l: l[:20], lambda l: l + ' 1 2 3', lambda l: l.rsplit(' ', 2)[0]):
            def damage(lines):
                lines[5] = change(lines[5])
            before = read(self.data + '/detections.txt')
            self.edit('detections.txt', damage)
            self.refused(self.run_data(), 3, 'detections.txt:6')
            write(self.data + '/detections.txt', before)
        self.edit_field('detections.txt', 5, last, '0.9x')
        self.refused(self.run_data(), 3, 'detections.txt:6', '0.9x')

    def test_sizes_that_cannot_be_are_dropped_and_counted(self):
        for row, value in enumerate(('nan', 'inf', '0', '-1.5')):
            self.edit_field('detections.txt', row, 10, value)
        result = self.run_data()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('4 of them dropped', result.stdout)
        self.assertIn('detections.txt:1', result.stderr)

    def test_scores_outside_the_range(self):
        self.edit_field('detections.txt', 3, -1, '1.5')
        self.refused(self.run_data('--score', 'probability'), 3, 'detections.txt:4', '1.5')
        self.assertEqual(self.run_data('--score', 'logit').returncode, 0)

    def test_stamps(self):
        before = read(self.data + '/times.txt')
        self.edit('times.txt', lambda lines: lines[:5] + [lines[4]] + lines[6:])
        self.refused(self.run_data(), 3, 'times.txt:6')
        write(self.data + '/times.txt', before)
        self.edit('times.txt', lambda lines: lines[:-3])
        result = self.run_data()  # stamped poses beyond the last frame are left out, loudly
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('3 poses come after the last', result.stderr)
        write(self.data + '/poses.txt', '1 0 0 0 0 1 0 0 0 0 1 0\n' * 40)  # no stamps: the counts must agree
        shutil.rmtree(self.out)
        self.refused(self.run_data('--odometry', 'poses.txt'), 3, '37', '40')

    def test_bad_poses(self):
        for column, value in ((7, '3.0'), (2, 'nan'), (3, 'abc')):
            before = read(self.data + '/odometry.txt')
            self.edit_field('odometry.txt', 9, column, value)
            self.refused(self.run_data(), 3, 'odometry.txt:10')
            write(self.data + '/odometry.txt', before)

    def test_a_matrix_that_is_no_rotation(self):
        rows = ['1 0 0 0 0 1 0 0 0 0 1 %d' % i for i in range(40)]
        rows[7] = '2 0 0 0 0 1 0 0 0 0 1 7'
        write(self.data + '/poses.txt', '\n'.join(rows) + '\n')
        self.refused(self.run_data('--odometry', 'poses.txt'), 3, 'poses.txt:8')

    def test_calibration_without_p2(self):
        self.edit('calib.txt', lambda lines: [l for l in lines if not l.startswith('P2')])
        self.refused(self.run_data(), 3, 'calib.txt', 'P2')

    # configuration
    def test_all_configuration_errors_at_once(self):
        path = self.data + '/c.yaml'
        write(path, 'mode: fast\nba:\n  max_iteratons: 3\n  loss_scale: two\n  loss_scale: 1\nmap:\n  caution: 1000\nnonsense: 1\n')
        for result in (call('check-config', path), self.run_data('--config', path)):
            self.refused(result, 4, f"{path}:1:7: 'mode' is 'fast', must be one of robust, paper",
                         f"{path}:3:3: unknown key 'max_iteratons' in 'ba' - did you mean 'max_iterations'?",
                         "'loss_scale' is 'two', must be a number", "duplicate key 'loss_scale' in 'ba'",
                         f"{path}:7:12: 'caution' is 1000, must be in [1, 100]", f"{path}:8:1: unknown key 'nonsense'")
        self.refused(self.run_data('--set', 'ba.lossscale=1', '--set', 'x'), 4,
                     "--set ba.lossscale=1: unknown key 'lossscale' in 'ba' - did you mean 'loss_scale'?", '--set x: expected')

    def test_dump_loads_back(self):
        for mode in ('robust', 'paper'):
            path = f'{self.data}/{mode}.yaml'
            write(path, call('dump-config', '--mode', mode).stdout)
            self.assertEqual(call('check-config', path).returncode, 0)
            self.assertEqual(call('dump-config', '--config', path).stdout, read(path))

    def test_usage(self):
        for args in ((), ('walk',), ('run',), ('run', self.data, '--format', 'bag'), ('run', self.data, '--max-frames', '-1')):
            self.assertEqual(call(*args).returncode, 2, args)

    # graph
    def graph(self, text, *args):
        write(self.data + '/in.g2o', text)
        return call('graph', self.data + '/in.g2o', '--out', self.out + '.g2o', *args)

    def square(self, *extra):
        """Four sides of 10 m, measured without error, then other rows."""
        information = '100 0 0 100 0 1000'
        steps = [f'EDGE_SE2 {i} {i + 1} 10 0 1.5707963267948966 {information}' for i in range(8)]
        return '\n'.join(steps + [row + ' ' + information for row in extra]) + '\n'

    def test_graph(self):
        true, false = 'EDGE_SE2 0 4 0 0.1 0', 'EDGE_SE2 1 7 5 5 1'
        result = self.graph(self.square(true, false), '--json')
        self.assertEqual(result.returncode, 0, result.stderr)
        plain = json.loads(result.stdout)
        self.assertGreater(plain['chi2_before'], plain['chi2_after'])
        self.assertEqual((plain['vertices'], plain['edges'], plain['loops'], plain['converged']), (9, 10, 2, 1))
        self.assertEqual(len(read(self.out + '.g2o').splitlines()), 19)

        result = self.graph(self.square(true, false), '--json', '--robust')
        robust = json.loads(result.stdout)
        self.assertLess(robust['chi2_after'], 1)
        self.assertEqual((robust['loops_kept'], robust['loops_refused']), (1, 1))
        written = read(self.out + '.g2o')
        self.assertIn('EDGE_SE3:QUAT 0 4 ', written)
        self.assertNotIn('EDGE_SE3:QUAT 1 7 ', written)
        # What was written can be read again, and is a minimum.
        again = call('graph', self.out + '.g2o', '--out', self.out + '.g2o', '--dof', '3', '--json')
        self.assertAlmostEqual(json.loads(again.stdout)['chi2_before'], robust['chi2_after'], places=4)

    def test_graph_says_what_it_did(self):
        result = self.graph(self.square('EDGE_SE2 0 8 0 0.1 0'), '--robust')
        for word in ('chi2_before', 'chi2_after', 'iterations', 'seconds', 'loops_kept', 'loops_refused', 'wrote '):
            self.assertIn(word, result.stdout)
        self.assertEqual(self.graph(self.square(), '--quiet').stdout, '')

    def test_graph_answers_do_not_depend_on_threads(self):
        written = []
        for threads in (1, 2, 2):
            self.graph(self.square('EDGE_SE2 0 4 0.1 0.2 0', 'EDGE_SE2 8 2 0 3 1'), '--robust', '--threads', threads)
            written.append(read(self.out + '.g2o'))
        self.assertEqual(written[0], written[1])
        self.assertEqual(written[0], written[2])

    def test_graph_degrees_of_freedom(self):
        rows = ['VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1', 'VERTEX_SE3:QUAT 1 1 0 0 0.1 0 0 0.99498743710662',
                'EDGE_SE3:QUAT 0 1 1 0 1 0 0 0.1 0.99498743710662' + ' 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1']
        moved = {}
        for dof in ('3', '4', '6'):
            self.assertEqual(self.graph('\n'.join(rows) + '\n', '--dof', dof).returncode, 0)
            moved[dof] = [float(x) for x in read(self.out + '.g2o').splitlines()[1].split()[2:]]
        self.assertAlmostEqual(moved['3'][2], 0)
        self.assertAlmostEqual(moved['4'][2], 1)
        self.assertAlmostEqual(moved['6'][3], 0)
        self.assertNotAlmostEqual(moved['4'][3], 0)

    def test_graph_parts(self):
        result = self.graph(self.square() + 'EDGE_SE2 20 21 1 0 0 1 0 0 1 0 1\n')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('2 parts that no edge joins', result.stderr)

    def test_bad_graphs(self):
        one, two = 'VERTEX_SE2 0 0 0 0\n', 'VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n'
        edge = 'EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n'
        for text, *messages in (
                ('', 'in.g2o: no EDGE'), (one, 'nothing to optimise'), (one + edge, 'in.g2o:2', 'vertex 1 has no VERTEX'),
                (two + one + edge, 'in.g2o:3', 'vertex 0 was given before'),
                (two + 'EDGE_SE2 0 1 1 0 nan 1 0 0 1 0 1\n', 'in.g2o:3', 'not finite'),
                (two + 'EDGE_SE2 0 1 1 0 0 1 0 0 -1 0 1\n', 'in.g2o:3', 'not positive definite'),
                (two + 'EDGE_SE2 0 1 1 0\n', 'in.g2o:3', 'expected 11 fields')):
            self.refused(self.graph(text), 3, *messages)
            self.assertFalse(os.path.exists(self.out + '.g2o'))
        self.refused(call('graph', self.data + '/absent.g2o', '--out', self.out + '.g2o'), 3, 'absent.g2o')
        self.assertEqual(call('graph', self.data + '/in.g2o').returncode, 2)
        self.assertEqual(self.graph(two + edge, '--dof', '5').returncode, 2)
        result = call('graph', self.data + '/in.g2o', '--out', self.data + '/odometry.txt/out.g2o')
        self.assertEqual(result.returncode, 1, result.stderr)

    # output
    def test_folders_that_cannot_be_written(self):
        for out in (self.data + '/odometry.txt/run', '/proc/run'):
            result = call('run', self.data, '--out', out)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn('cannot be written', result.stderr)

    def test_full_disk(self):
        with open('/dev/full', 'w') as full:
            result = subprocess.run([RUN, 'run', self.data, '--out', self.out, '--json'], stdout=full,
                                    stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(result.returncode, 1)
        self.assertIn('full', result.stderr)

    def test_full_disk_leaves_nothing_half_written(self):
        os.makedirs(self.out)
        mount = subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=8k', 'tmpfs', self.out], capture_output=True)
        if mount.returncode != 0:
            self.skipTest('skipped: mounting a tmpfs is not permitted')
        try:
            result = self.run_data()
            self.assertEqual(result.returncode, 1)
            self.assertIn('No space left', result.stderr)
            for name in os.listdir(self.out):
                self.assertNotIn('.tmp-', name)
        finally:
            subprocess.run(['umount', self.out], check=True)

    def test_interrupt_keeps_what_there_is(self):
        long = self.data + '/long'
        subprocess.run([SIM, 'street', '--out', long, '--seed', '3', '--frames', '6000'], check=True, capture_output=True)
        process = subprocess.Popen([RUN, 'run', long, '--out', self.out, '--set', 'refine.enabled=false'],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process.stdout.readline()  # the dataset is loaded
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertIn('interrupted', stderr)
        rows = len(read(self.out + '/trajectory_tum.txt').splitlines())
        self.assertTrue(0 < rows < 6000, rows)
        json.loads(read(self.out + '/map.json'))

    # match
    def pairs(self, *rows):
        path = f'{self.data}/pairs.txt'
        write(path, '\n'.join(rows) + '\n')
        return path

    def strewn_pairs(self):
        """Two pairs: a map and a part of it turned by a quarter; a local map without objects."""
        spots = [(0, 0), (7, 1), (13, -4), (3, 12), (-9, 5), (-4, -11), (18, 9), (-15, -3)]
        rows = ['# comment', f'PAIR 5 made/up {len(spots)} {len(spots)} 1.5707963 10 20 0.5']
        rows += [f'L -1 {k % 3} {y} {-x} 0' for k, (x, y) in enumerate(spots)]
        rows += [f'G {k} {k % 3} {x + 10} {y + 20} 0.5' for k, (x, y) in enumerate(spots)]
        return self.pairs(*rows, 'PAIR 6 empty 0 1 0 0 0 0', 'G 0 0 1 2 3')

    def test_match_prints_a_row_per_pair(self):
        result = call('match', self.strewn_pairs())
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        rows = [row.split(',') for row in result.stdout.splitlines()]
        self.assertEqual(rows[0], 'pair,decision,yaw_rad,tx,ty,tz,score,second_score,matches,ms'.split(','))
        self.assertEqual(rows[1][:2] + rows[1][8:9], ['5', 'accepted', '8'])
        for value, truth in zip(rows[1][2:6], (1.5707963, 10, 20, 0.5)):
            self.assertAlmostEqual(float(value), truth, places=3)
        self.assertEqual(rows[2][:2], ['6', 'none'])
        self.assertEqual(len(rows), 3)

    def test_match_writes_the_same_for_any_thread_count(self):
        answers = []
        for threads in (1, 4):
            out = f'{self.data}/answers{threads}.csv'
            result = call('match', self.strewn_pairs(), '--out', out, '--threads', threads)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn('2 pairs: 1 accepted, 0 ambiguous, 1 none', result.stdout)
            answers.append([row.rsplit(',', 1)[0] for row in read(out).splitlines()])
        self.assertEqual(answers[0], answers[1])
        quiet = call('match', self.strewn_pairs(), '--out', f'{self.data}/q.csv', '--quiet')
        self.assertEqual((quiet.returncode, quiet.stdout, quiet.stderr), (0, '', ''))

    def test_match_takes_modes_and_settings(self):
        strict = call('match', self.strewn_pairs(), '--set', 'loop.match.decision.min_margin=900')
        self.assertIn('5,ambiguous', strict.stdout)
        self.assertEqual(call('match', self.strewn_pairs(), '--mode', 'paper').returncode, 0)
        unknown = call('match', self.strewn_pairs(), '--set', 'loop.match.decision.min_margn=9')
        self.assertEqual(unknown.returncode, 4)
        self.assertIn("did you mean 'min_margin'", unknown.stderr)

    def test_match_refuses_bad_files(self):
        def refuse(code, path, *messages):
            result = call('match', path)
            self.assertEqual((result.returncode, result.stdout), (code, ''), result.stderr)
            for message in messages:
                self.assertIn(message, result.stderr)
        pair = 'PAIR 0 s 1 0 0 0 0 0'
        refuse(3, self.data + '/none.txt', 'none.txt', 'No such file')
        refuse(3, self.pairs(''), 'pairs.txt: holds no pair')
        refuse(3, self.pairs(pair), 'pairs.txt:1: pair 0 announces 1 L rows, but has 0')
        refuse(3, self.pairs(pair, 'L 0 0 1 nan 3'), "pairs.txt:2: column 5 is 'nan'")
        refuse(3, self.pairs(pair, 'Q 0 0 1 2 3'), "pairs.txt:2: a row starts with PAIR, L or G, not with 'Q'")
        refuse(3, self.data, 'is a folder')
        self.assertEqual(call('match').returncode, 2)
        self.assertEqual(call('match', self.strewn_pairs(), '--threads', '0').returncode, 2)
        unwritable = call('match', self.strewn_pairs(), '--out', self.data + '/no/such/folder.csv')
        self.assertEqual(unwritable.returncode, 1, unwritable.stderr)


if __name__ == '__main__':
    RUN, SIM = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
