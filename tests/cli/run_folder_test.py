#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a run's folder says of it, and its comparison with the truth. usage: see cli_case.main"""
import fcntl
import hashlib
import json
import os

from cli_case import CliCase, call, read, write, main


class RunFolderTest(CliCase):
    def test_a_run_describes_itself(self):
        write(self.data + '/sequence.yaml', 'labels: {Boat: {symmetry: none}}\n')
        result = self.run_data('--groundtruth', 'groundtruth.txt')
        record = json.loads(read(self.out + '/run.json'))
        self.assertIn(record['program']['commit'], call('version').stdout)
        self.assertEqual(record['command'][1:5], ['run', self.data, '--out', self.out])
        self.assertEqual([f'warning: {w}' for w in record['warnings']], result.stderr.splitlines())
        self.assertTrue(record['complete'] and record['warnings'] and record['wall_s'] > 0 and record['cpu_s'] > 0)
        objects = json.loads(read(self.out + '/map.json'))['objects']
        self.assertEqual((record['counts']['frames'], record['counts']['landmarks']),
                         (40, sum(o['state'] == 'confirmed' for o in objects)))
        self.assertEqual({file['role'] for file in record['inputs']} & {'odometry', 'detections', 'ground truth', 'identities'},
                         {'odometry', 'detections', 'ground truth', 'identities'})
        self.assertEqual(record['check'], json.loads(call('check', self.data, '--groundtruth', 'groundtruth.txt', '--json').stdout)['checks'])
        listed = [(file['path'], file) for file in record['inputs']]
        listed += [(f'{self.out}/{file["name"]}', file) for file in record['files']]
        for path, file in listed:
            with open(path, 'rb') as content:
                data = content.read()
            self.assertEqual((len(data), hashlib.sha256(data).hexdigest()), (file['bytes'], file['sha256']), path)
        self.assertEqual({path for path, _ in listed} & set(os.listdir(self.out)), set())
        self.assertEqual({file['name'] for file in record['files']} | {'run.json'}, set(os.listdir(self.out)))

    def test_files_of_two_runs_are_noticed(self):
        self.run_data()
        write(self.out + '/odometry_tum.txt', read(self.out + '/trajectory_tum.txt'))  # as a killed run leaves it
        result = call('eval', self.out, '--groundtruth', self.data + '/groundtruth.txt')
        self.assertEqual((result.returncode, result.stdout), (3, ''))
        self.assertIn(self.out + '/odometry_tum.txt: is not the file that', result.stderr)

    def test_a_folder_has_one_writer_at_a_time(self):
        lock_path, holder = self.out + '/.sslcd-lock', 'process 1 on somewhere since yesterday (sslcd_run run tuesday)'
        write(lock_path, holder)
        commands = [('run', self.data, '--out', self.out), ('run', self.data, '--out', self.out, '--force'),
                    ('bench', 'table2', '--out', self.out)]
        with open(lock_path) as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            for command in commands:
                self.refused(call(*command), 1, f'{self.out}: is being written by {holder}; wait')
            self.assertEqual((os.listdir(self.out), read(lock_path)), (['.sslcd-lock'], holder))
        self.assertEqual(call(*commands[0]).returncode, 0, 'a lock ends with its holder')
        self.assertFalse(os.path.exists(lock_path))

    def test_a_folder_with_files_of_two_calls_is_refused(self):
        write(self.data + '/.sslcd-unfinished-sequence', '')  # as a killed 'detect' leaves it
        for command in (('run', self.data, '--out', self.out), ('check', self.data)):
            self.refused(call(*command), 3, self.data + ': its files may be of two calls', 'repeat', 'or delete ')

    def test_another_run_is_not_overwritten(self):
        first = ('run', self.data, '--out', self.out)
        self.assertEqual(call(*first).returncode, 0)
        self.assertEqual(call(*first, '--quiet').returncode, 0, 'the same command again')
        before = read(self.out + '/run.json')
        result = call(*first, '--mode', 'paper')
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, rf"{self.out}: holds the run '\S*sslcd_run run {self.data} --out {self.out} --quiet' of 20.*--force")
        self.assertEqual(read(self.out + '/run.json'), before)
        self.assertEqual(call(*first, '--mode', 'paper', '--force').returncode, 0)
        os.remove(self.out + '/run.json')
        result = call(*first)
        self.assertEqual(result.returncode, 2)
        self.assertIn('no run.json', result.stderr)
        for _ in range(2):  # the default folder holds whatever was last
            self.assertEqual(call('run', self.data, '--max-frames', 5 + _, cwd=self.data).returncode, 0)

    def test_ground_truth_at_another_rate(self):
        def error(*options):
            return json.loads(self.run_data('--groundtruth', 'groundtruth.txt', '--json', *options).stdout)['ate_se3_rmse_m']
        whole = error()
        self.edit('groundtruth.txt', lambda lines: lines[::2])
        self.assertAlmostEqual(error('--max-frames', 39), whole, delta=0.5 * whole)
        self.edit('groundtruth.txt', lambda lines: [' '.join([str(1e9 + float(l.split()[0]))] + l.split()[1:]) for l in lines])
        result = self.run_data('--groundtruth', 'groundtruth.txt')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, 'groundtruth.txt: no stamp .* is of the time of a frame .*; it is not used')
        self.assertEqual(json.loads(read(self.out + '/metrics.json')), {})


if __name__ == '__main__':
    main()
