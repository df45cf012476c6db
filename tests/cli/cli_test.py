#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run run and the configuration: good, bad and odd input. usage: see cli_case.main"""
import json
import os
import shutil
import signal
import subprocess
import time

from cli_case import CliCase, binaries, call, read, write, main


class CliTest(CliCase):
    # what works
    def test_good_run_writes_everything(self):
        result = self.run_data('--groundtruth', 'groundtruth.txt')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(self.out)), sorted([
            'trajectory_tum.txt', 'trajectory_kitti.txt', 'odometry_tum.txt', 'odometry_kitti.txt', 'map.json', 'map.ply',
            'graph.g2o', 'loops.csv', 'timing.json', 'metrics.json', 'config.yaml', 'groundtruth_tum.txt', 'run.json']))
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
        # True identities lie beside the detections.
        self.assertEqual((metrics['loops'], metrics['loops_wrong'], metrics['loop_error_median_m']), (0, 0, None))
        self.assertGreater(metrics['purity'], 0.95)
        self.assertGreater(sum(o['state'] == 'confirmed' for o in json.loads(read(self.out + '/map.json'))['objects']), 3)
        json.loads(read(self.out + '/timing.json'))
        named = call('run', self.data, '--detections', self.data + '/detections.txt', '--out', self.out + '_named')
        self.assertEqual((named.returncode, json.loads(read(self.out + '_named/metrics.json'))), (0, metrics))
        write(self.data + '/none.txt', '')
        nothing = call('eval', self.out, '--groundtruth', self.data + '/none.txt')
        self.assertEqual(nothing.returncode, 3)
        self.assertIn('none.txt: has no poses', nothing.stderr)
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

    def test_true_identities_need_true_poses_and_a_row_for_each_detection(self):
        write(self.data + '/landmark_ids.txt', '1\n2\n')
        self.assertIn('landmark_ids.txt: has 2 rows', self.run_data().stderr)
        self.assertNotIn('purity', json.loads(read(self.out + '/metrics.json')))
        write(self.data + '/others.txt', read(self.data + '/detections.txt'))
        self.assertEqual(self.run_data('--detections', self.data + '/others.txt').stderr, '', 'not those of these detections')
        os.remove(self.data + '/groundtruth.txt')
        self.assertEqual(self.run_data().stderr, '')
        self.assertEqual(json.loads(read(self.out + '/metrics.json')), {})

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
        self.assertRegex(result.stdout, r'no loop was found\n.*\n.*\n  searches +\d+\n    too few objects')
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
        version = call('version').stdout
        self.assertRegex(version, r'^sslcd \d+\.\d+\.\d+ \(commit \S+\)\n$')
        self.assertEqual(call('--version').stdout, version)

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

    def test_a_map_is_judged_by_true_poses_only(self):
        self.assertEqual(self.run_data().returncode, 0)
        tracking, label = self.data + '/tracking', self.data + '/tracking/label_02/0007.txt'
        for name, source in (('calib', self.data + '/calib.txt'), ('detections', self.data + '/detections.txt'),
                             ('poses', self.out + '/odometry_kitti.txt')):
            write(f'{tracking}/{name}/0007.txt', read(source))
        write(label, ''.join(f'{i} 0 Car 0 0 0 0 0 9 9 1.5 1.7 4 2 1.5 10 0\n' for i in range(40)))
        run = ('run', tracking, '--sequence', '0007', '--detections', 'detections', '--odometry', 'poses', '--out', self.out, '--force')
        result = call(*run)
        self.assertEqual((result.returncode, json.loads(read(self.out + '/metrics.json'))), (0, {}), result.stderr)
        self.assertEqual(result.stderr.count(label + ': no ground-truth poses'), 1, result.stderr)
        result = call(*run, '--groundtruth', 'poses', '--no-check')  # its poles have no symmetry without sequence.yaml
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        self.assertIn('iou_map', json.loads(read(self.out + '/metrics.json')))

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

    def test_too_many_detections_are_dropped_with_a_warning(self):
        result = self.run_data('--set', 'filter.max_count=3')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('filter.max_count', result.stderr)
        self.assertIn('detections dropped', result.stdout)
        self.assertNotIn('filter.max_count', self.run_data().stderr)

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
        write(path, 'mode: fast\nba:\n  max_iteratons: 3\n  loss_scale: two\n  loss_scale: 1\nmap:\n  birth_score: 1000\nnonsense: 1\n')
        for result in (call('check-config', path), self.run_data('--config', path)):
            self.refused(result, 4, f"{path}:1:7: 'mode' is 'fast', must be one of robust, paper",
                         f"{path}:3:3: unknown key 'max_iteratons' in 'ba' - did you mean 'max_iterations'?",
                         "'loss_scale' is 'two', must be a number", "duplicate key 'loss_scale' in 'ba'",
                         f"{path}:7:16: 'birth_score' is 1000, must be in [0, 1]", f"{path}:8:1: unknown key 'nonsense'")
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

    def test_folders_that_cannot_be_written(self):
        for out in (self.data + '/odometry.txt/run', '/proc/run'):
            result = call('run', self.data, '--out', out)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn('cannot be written', result.stderr)

    def test_full_disk(self):
        with open('/dev/full', 'w') as full:
            result = subprocess.run([binaries['run'], 'run', self.data, '--out', self.out, '--json'], stdout=full,
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

    def test_code_and_inputs_are_safe_from_a_data_folder(self):
        write(self.data + '/config.yaml', 'vision: {inference: {library: evil.so}}\n')
        for config in (self.data + '/config.yaml', self.root + '/link.yaml'):
            if not os.path.exists(config):
                os.symlink(self.data + '/config.yaml', config)
            result = self.run_data('--config', config)
            self.assertEqual(result.returncode, 4, result.stderr)
            self.assertIn('vision.inference.library names code to run', result.stderr)
        shutil.copy(self.data + '/config.yaml', self.root + '/own.yaml')
        self.assertEqual(self.run_data('--config', self.root + '/own.yaml').returncode, 0)
        result = call('run', self.data, '--out', self.data + '/')
        self.assertEqual(result.returncode, 2)
        self.assertIn('is the data set', result.stderr)

    def test_a_terminal_gets_no_control_characters_of_a_file(self):
        write(self.data + '/sequence.yaml', '"a\\e[31mb": c\n')
        result = self.run_data()
        self.assertEqual(result.returncode, 3)
        self.assertIn('a\\x1b[31mb', result.stderr)

    def test_interrupt_keeps_what_there_is(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(signal=number):
                self.interrupt(number)

    def test_a_run_under_nohup_outlives_its_terminal(self):
        process = subprocess.Popen([binaries['run'], 'run', self.data, '--out', self.out], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        while process.poll() is None:
            process.send_signal(signal.SIGHUP)
            time.sleep(0.001)
        self.assertEqual((process.returncode, process.communicate()[1]), (0, ''))

    def test_interrupt_before_the_first_true_pose_keeps_what_there_is(self):
        stderr = self.interrupt(signal.SIGINT, true_poses=slice(-10, None))
        self.assertIn('warning: no metrics: no pose of the estimate', stderr)

    def interrupt(self, number, true_poses=slice(None)):
        long = f'{self.data}/long{number}'
        subprocess.run([binaries['sim'], 'street', '--out', long, '--seed', '3', '--frames', '6000'], check=True, capture_output=True)
        truth = long + '/groundtruth.txt'
        write(truth, ''.join(read(truth).splitlines(keepends=True)[true_poses]))
        process = subprocess.Popen([binaries['run'], 'run', long, '--out', self.out, '--force', '--set', 'refine.enabled=false'],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process.stdout.readline()  # the dataset is loaded
        time.sleep(0.5)
        process.send_signal(number)
        _, stderr = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + number, stderr)
        self.assertIn('interrupted', stderr)
        rows = len(read(self.out + '/trajectory_tum.txt').splitlines())
        self.assertTrue(0 < rows < 6000, rows)
        json.loads(read(self.out + '/map.json'))
        return stderr


if __name__ == '__main__':
    main()
