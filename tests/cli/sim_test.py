#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_sim: HALV-sim and its calibration. usage: see cli_case.main"""
import json
import os
import subprocess

from cli_case import CliCase, binaries, call, read, write, main

FILES = ['calib.txt', 'colours.npy', 'detections.txt', 'embeddings.npy', 'groundtruth.txt', 'landmark_ids.txt',
         'odometry.txt', 'sequence.yaml', 'times.txt']


def sim(*args):
    return subprocess.run([binaries['sim'], *map(str, args)], capture_output=True, text=True, timeout=60)


def read_bytes(path):
    with open(path, 'rb') as file:
        return file.read()


class SimTest(CliCase):
    def refused_sim(self, code, *args_and_messages):
        args, messages = args_and_messages
        result = sim('halv', '--out', self.out, *args)
        self.assertEqual(result.returncode, code, result.stderr)
        for message in messages:
            self.assertIn(message, result.stderr)
        self.assertFalse(os.path.exists(self.out), 'a refused call must leave nothing')

    def test_every_case_is_a_sequence_that_runs(self):
        for case in (1, 2, 3, 4):
            folder = f'{self.out}{case}'
            result = sim('halv', '--case', case, '--seed', 2, '--out', folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(sorted(os.listdir(folder)), FILES)
            rows = len(read(folder + '/detections.txt').splitlines())
            self.assertEqual(rows, len(read(folder + '/landmark_ids.txt').splitlines()))
            self.assertGreater(rows, 1000)
        result = call('run', self.out + '4', '--out', self.out + 'run', '--json', '--groundtruth', 'groundtruth.txt')
        self.assertEqual(result.returncode, 0, result.stderr)
        metrics = json.loads(result.stdout)
        self.assertLess(metrics['ate_sim3_rmse_m'], metrics['odometry_ate_sim3_rmse_m'])

    def test_same_seed_same_bytes(self):
        for name, seed in (('a', 3), ('b', 3), ('c', 4)):
            self.assertEqual(sim('halv', '--case', 4, '--seed', seed, '--out', self.out + name).returncode, 0)
        for name in FILES:
            same = read_bytes(f'{self.out}a/{name}') == read_bytes(f'{self.out}b/{name}')
            self.assertTrue(same, name)
        self.assertNotEqual(read(self.out + 'a/detections.txt'), read(self.out + 'c/detections.txt'))

    def test_render(self):
        """Renders images if this build has Embree, otherwise an error names the remedy."""
        args = ('--case', 4, '--size', 0.3, '--speed-mps', 20, '--render-scale', 0.1)
        result = sim('halv', *args, '--out', self.out, '--render', '--render-truth', '--threads', 2)
        if 'Embree' in result.stderr:
            self.assertEqual(result.returncode, 2)
            self.assertIn('libembree-dev', result.stderr)
            self.assertFalse(os.path.exists(self.out))
            return
        self.assertEqual(result.returncode, 0, result.stderr)
        frames = len(read(self.out + '/times.txt').splitlines())
        for name in ('image_2', 'image_3', 'depth_2', 'depth_3', 'instance_2', 'instance_3'):
            self.assertEqual(sorted(os.listdir(f'{self.out}/{name}')), [f'{i:06d}.png' for i in range(frames)])
        run = call('run', self.out, '--out', self.out + 'run')
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn('no image', run.stderr)
        self.refused_render('vignetting', '--vignetting', 2)
        self.refused_render('threads', '--threads', 0)

    def test_images_make_loops_of_objects_more_exact(self):
        """Where objects close loops, the ground in the images of both passes is laid over each other."""
        args = ('--case', 4, '--seed', 1, '--speed-mps', 5, '--render-scale', 0.5, '--threads', 2)
        rendered = sim('halv', *args, '--out', self.out, '--render')
        if 'Embree' in rendered.stderr:
            self.skipTest('this build has no Embree')
        self.assertEqual(rendered.returncode, 0, rendered.stderr)

        def loop_error(*options):
            run = call('run', self.out, '--out', self.out + 'run', '--force', '--groundtruth', 'groundtruth.txt', *options)
            self.assertEqual(run.returncode, 0, run.stderr)
            edges = sum(row.startswith('EDGE') for row in read(self.out + 'run/graph.g2o').splitlines())
            return json.loads(read(self.out + 'run/metrics.json'))['loop_error_median_m'], edges, run.stderr

        by_objects, edges, _ = loop_error('--set', 'loop.views.enabled=false')
        by_images, edges_by_images, warnings = loop_error()
        self.assertNotEqual(edges_by_images, edges)
        self.assertNotIn('not aligned', warnings)
        self.assertLess(by_images, 0.75 * by_objects)
        for name in sorted(os.listdir(self.out + '/image_3'))[::2]:  # what cannot be read must not stop a run
            with open(f'{self.out}/image_3/{name}', 'wb') as file:
                file.write(b'no image')
        by_the_others, _, warnings = loop_error()
        self.assertLess(by_the_others, 1.1 * by_objects)
        self.assertEqual(warnings.count('it cannot be read'), 1, 'said once')

    def refused_render(self, message, *args):
        out = self.out + 'refused'
        result = sim('halv', '--case', 4, '--out', out, '--render', *args)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(message, result.stderr)
        self.assertFalse(os.path.exists(out), 'a refused call must leave nothing')

    def test_nothing_true_but_where_it_belongs(self):
        """What the estimator reads is the same whatever the truth is called."""
        self.assertEqual(sim('halv', '--case', 4, '--seed', 3, '--out', self.out).returncode, 0)
        for row in read(self.out + '/detections.txt').splitlines():
            self.assertEqual(row.split()[1], '-1', 'no track ids')
        calls = []
        for name in ('with', 'without'):
            calls.append(call('run', self.out, '--out', f'{self.out}_{name}'))
            for truth in ('groundtruth.txt', 'landmark_ids.txt'):
                if os.path.exists(f'{self.out}/{truth}'):
                    os.remove(f'{self.out}/{truth}')
        self.assertEqual([c.returncode for c in calls], [0, 0])
        self.assertEqual(read(self.out + '_with/trajectory_tum.txt'), read(self.out + '_without/trajectory_tum.txt'))
        metrics, nothing = (json.loads(read(f'{self.out}_{name}/metrics.json')) for name in ('with', 'without'))
        self.assertEqual(nothing, {})
        accepted = sum(',accepted,' in row for row in read(self.out + '_with/loops.csv').splitlines())
        self.assertGreater(accepted, 5)
        self.assertEqual((metrics['loops'], metrics['loops_wrong']), (accepted, 0))
        self.assertGreater(metrics['revisits_recognised'], 0.8)
        self.assertLess(metrics['loop_error_median_m'], 1)

    def test_loops_are_not_judged_by_part_of_the_truth(self):
        self.assertEqual(sim('halv', '--case', 4, '--seed', 3, '--out', self.out).returncode, 0)
        write(self.out + '/groundtruth.txt', ''.join(read(self.out + '/groundtruth.txt').splitlines(True)[:-5]))
        result = call('run', self.out, '--out', self.out + '_part')
        self.assertEqual(result.returncode, 0)
        self.assertIn('loops are not judged', result.stderr)
        self.assertNotIn('loops_wrong', json.loads(read(self.out + '_part/metrics.json')))

    def test_layout_file(self):
        cars = [{'x': 2.7 * (i % 20), 'y': 12. * (i // 20), 'z': 0.4, 'qx': 0, 'qy': 0, 'qz': 0, 'w': 1} for i in range(60)]
        layout = self.data + '/cars.json'
        write(layout, json.dumps(cars))
        result = sim('halv', '--case', 4, '--layout', layout, '--out', self.out, '--churn', 0.3)
        self.assertEqual(result.returncode, 0, result.stderr)
        write(layout, '[{"x": 1, "y": 2, "z": 0, "qx": 0, "qy": 0}]')
        self.out += '2'
        self.refused_sim(3, ['--layout', layout], ['cars.json:1', "'qz' is missing"])
        self.refused_sim(3, ['--layout', layout + 'x'], ['cars.jsonx'])
        write(layout, json.dumps(cars[:12]))
        self.refused_sim(2, ['--layout', layout, '--case', 1], ['leaves the lot', '--size'])

    def test_impossible_options(self):
        self.refused_sim(2, ['--taken-fraction', 0], ['no cars', '--taken-fraction'])
        self.refused_sim(2, ['--flip-rate', -1], ['flip_rate is -1', '0 to 1'])
        self.refused_sim(2, ['--radial-m', -1, '--miss-rate-far', 2], ['radial_m is -1', 'miss_rate_far is 2'])
        self.refused_sim(2, ['--case', 5], ['case is 5', '1 to 4'])
        self.refused_sim(2, ['--viewpoint-low-deg', 90, '--viewpoint-high-deg', 20], ['viewpoint_low_deg'])
        self.refused_sim(2, ['--ate-m', 500], ['cannot drift', '--ate-m'])
        self.refused_sim(2, ['--same-side', 0.1], ['same_side'])
        self.refused_sim(2, ['--nonsense'], [])

    def test_calibration_prints_a_table(self):
        result = sim('calibrate', '--seeds', 2)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        rows = result.stdout.splitlines()
        self.assertEqual(rows[0], '| what | target | reached | within 10 % |')
        self.assertEqual(len(rows), 14)
        self.assertEqual(sim('calibrate', '--seeds', 1, '--scale', 0.1).returncode, 5)
        self.assertEqual(sim('calibrate', '--seeds', 0).returncode, 2)


if __name__ == '__main__':
    main()
