#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a run's folder says of it, and its comparison with the truth. usage: see cli_case.main"""
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
