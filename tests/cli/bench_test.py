#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run bench: tables, results that are kept, and what goes wrong. usage: see cli_case.main"""
import csv
import json
import os
import signal
import subprocess
import time

from cli_case import CliCase, binaries, call, read, write, main

ONE = ('--seeds', 1, '--cases', 4, '--threads', 1)
SMALL = (*ONE, '--methods', 'sslcd,no_loops,one_look')


class BenchTest(CliCase):
    def bench(self, name, *args):
        return call('bench', name, '--out', self.out, *args)

    def read_csv(self, name):
        with open(f'{self.out}/{name}.csv') as file:
            return list(csv.DictReader(file))

    def test_table_of_trajectory_errors_three_ways(self):
        result = self.bench('table2', *SMALL)
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.read_csv('table2')
        error = {row['method']: float(row['4 RMSE']) for row in rows}
        self.assertLess(error['**sslcd**'], error['sslcd without loops'])
        self.assertLess(error['sslcd without loops'], error['the odometry as it comes'])
        self.assertEqual(error["Ji et al. (the paper's figures, on HALV)"], 0.161)
        listed = json.loads(read(f'{self.out}/table2.json'))
        self.assertEqual([row['4 RMSE'] for row in listed], [float(row['4 RMSE']) for row in rows])
        self.assertIn(read(f'{self.out}/table2.md'), result.stdout)
        self.assertIn('Commit ', read(f'{self.out}/table2.md'))

    def test_pages_that_cannot_be_are_refused_before_the_runs(self):
        baselines = self.out + '.yaml'
        write(baselines, '{}')
        for page, code in ((os.path.dirname(self.out), 1), (self.out + '_no/page.html', 1), (baselines, 2)):
            result = self.bench('pr', *ONE, '--baselines', baselines, '--report', page)
            if 'libjs-three' in result.stderr:
                self.skipTest('skipped: built without three.js and Chart.js')
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertIn(page, result.stderr)
            self.assertFalse(os.path.exists(self.out + '/pr.csv'))
        self.assertEqual(read(baselines), '{}')

    def test_json_and_page(self):
        page = self.out + '.html'
        result = self.bench('pr', *ONE, '--methods', 'sslcd,one_look', '--report', page, '--json')
        if 'libjs-three' in result.stderr:
            self.skipTest('skipped: built without three.js and Chart.js')
        shown = json.loads(result.stdout)
        self.assertEqual(shown['tables'], {'pr': json.loads(read(self.out + '/pr.json'))})
        self.assertEqual([each['path'] for each in shown['written']],
                         [f'{self.out}/pr.{end}' for end in ('md', 'json', 'csv')] + [self.out + '/pr_curves.csv', page])
        for each in shown['written']:
            self.assertEqual(each['bytes'], os.path.getsize(each['path']))
        text = read(page)
        self.assertNotIn('src=', text)
        data = json.loads(text.split('id="data">')[1].split('</script>')[0])
        self.assertIn('Commit ', data['tables'][0]['note'])
        cells = [list(row.values()) for row in self.read_csv('pr')]
        self.assertEqual((data['tables'][0]['rows'], data['tables'][0]['header']), (cells, list(self.read_csv('pr')[0])))
        self.assertEqual(data['curves'][0]['rows'], [list(row.values()) for row in self.read_csv('pr_curves')])

    def test_what_is_there_is_not_measured_again(self):
        self.assertEqual(self.bench('table2', *SMALL).returncode, 0)
        trials = self.out + '/trials/'
        before = {name: os.stat(trials + name).st_mtime_ns for name in os.listdir(trials)}
        self.assertEqual(len(before), 3)
        result = self.bench('table2', *SMALL)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(before, {name: os.stat(trials + name).st_mtime_ns for name in os.listdir(trials)})

    def test_attempts_curves_and_times(self):
        for name in ('attempts', 'pr', 'table3', 'ablation'):
            result = self.bench(name, '--seeds', 1, '--cases', 4, '--quiet')
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(result.stdout, '')
        attempts = self.read_csv('attempts')
        self.assertEqual([row['viewpoint [deg]'] for row in attempts], ['0-45', '45-90', '90-135', '135-180', 'all'])
        self.assertGreater(int(attempts[0]['recognised']), 0)
        self.assertEqual(attempts[4]['off by > 5 m'], '0')
        loops = [row for row in self.read_csv('loops') if row['place'] == 'lot']
        self.assertEqual(len(loops), int(attempts[4]['loops']))
        curves = self.read_csv('pr_curves')
        self.assertEqual({row['method'] for row in curves} & {'sslcd', 'one_look'}, {'sslcd', 'one_look'})
        for row in curves:
            self.assertLessEqual(float(row['precision_low']), float(row['precision']))
        self.assertIn('loop detection', [row['stage'] for row in self.read_csv('table3')])
        self.assertGreater(len(self.read_csv('ablation')), 5)

    def test_recall_over_viewpoint(self):
        result = self.bench('viewpoint', *ONE, '--viewpoints', '60-75,75-90', '--methods', 'sslcd,x_view')
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.read_csv('viewpoint_curves')
        keyframes = {method: [(row['viewpoint_deg'], row['keyframes']) for row in rows if row['method'] == method]
                     for method in ('sslcd', 'x_view')}
        self.assertEqual(keyframes['sslcd'], keyframes['x_view'], 'judged on the same ones')
        self.assertGreater(int(dict(keyframes['sslcd'])['60-75']), 3)
        self.assertEqual(len(self.read_csv('viewpoint')), len(keyframes['sslcd']))
        recognised = {row['viewpoint_deg']: int(row['recognised']) for row in rows if row['method'] == 'sslcd'}
        self.assertGreater(recognised['75-90'], 0)
        worlds = {name.rsplit('-', 1)[0] for name in os.listdir(self.out + '/trials') if name.endswith('-sslcd.json')}
        self.assertEqual(worlds, {'lot-c4-s1', 'lot-v60-75-c4-s1', 'lot-v75-90-c4-s1'})

    def test_rendered_worlds_are_those_of_the_table(self):
        images, name = self.out + '_images', 'lot-v60-75-c4-s1'
        asked = (*ONE, '--viewpoints', '60-75', '--methods', 'appearance', '--images', images)
        os.makedirs(images)
        self.refused(self.bench('viewpoint', *asked), 3, 'lot-c4-s1: is not there',
                     'sslcd_sim halv --case 4 --seed 1 --render --out ' + images)
        for world, seed in (('lot-c4-s1', '1'), (name, '2')):  # the second one is not what its name says
            subprocess.run([binaries['sim'], 'halv', '--case', '4', '--seed', seed, '--out', f'{images}/{world}'],
                           check=True, capture_output=True)
            os.makedirs(f'{images}/{world}/image_2')
        self.refused(self.bench('viewpoint', *asked), 3, name + ': is of another world', '--viewpoint-low-deg 60 ')

    def test_bad_options_are_noticed_before_the_first_run(self):
        images = self.out + '_images'
        os.makedirs(images)
        self.refused(self.bench('all', *SMALL, '--viewpoints', '60-75,75'), 2, "--viewpoints '75'")
        for name in ('table2', 'pr', 'all'):
            result = self.bench(name, *ONE, '--methods', 'sslcd,appearance', '--images', images)
            self.refused(result, 3, 'lot-c4-s1: is not there', '--render --out ' + images)
        self.assertEqual(os.listdir(self.out + '/trials'), [])

    def test_a_range_counts_once(self):
        result = self.bench('viewpoint', *ONE, '--viewpoints', '60-75,60-75,060-75', '--methods', 'sslcd')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(os.listdir(self.out + '/trials')), 2)
        once = self.read_csv('viewpoint')
        self.out += '_once'
        self.assertEqual(self.bench('viewpoint', *ONE, '--viewpoints', '60-75', '--methods', 'sslcd').returncode, 0)
        self.assertEqual(once, self.read_csv('viewpoint'))

    def test_into_a_document(self):
        write(self.out + '.md', 'Above.\n<!-- bench table2 -->\n<!-- /bench -->\nBelow.\n')
        result = self.bench('table2', *SMALL, '--docs', self.out + '.md')
        self.assertEqual(result.returncode, 0, result.stderr)
        text = read(self.out + '.md')
        self.assertTrue(text.startswith('Above.\n') and text.endswith('Below.\n'))
        self.assertIn('| **sslcd** |', text)
        write(self.out + '.md', 'Nothing.\n')
        result = self.bench('table2', *SMALL, '--docs', self.out + '.md')
        self.refused(result, 3, '.md: has no place for table2')
        self.assertEqual(read(self.out + '.md'), 'Nothing.\n')
        self.refused(self.bench('table2', *SMALL, '--docs', self.out + '/none.md'), 3, 'none.md: cannot be read')

    def test_trajectories_of_another_system(self):
        sim = [binaries['sim'], 'halv', '--case', '4', '--seed', '1', '--out', self.out + '_halv']
        subprocess.run(sim, check=True, capture_output=True)
        write(self.out + '_other/lot-c4-s1.txt', read(self.out + '_halv/odometry.txt'))
        other = f'Other={self.out}_other'
        result = self.bench('table2', *SMALL, '--trajectories', other)
        self.assertEqual(result.returncode, 0, result.stderr)
        page = self.out + '.html'
        evil = self.bench('table2', *SMALL, '--trajectories', '</script><b>' + other, '--report', page)
        if 'libjs-three' not in evil.stderr:
            self.assertEqual(evil.returncode, 0, evil.stderr)
            self.assertIn('\\u003c/script>\\u003cb>Other', read(page), 'names of methods stay text')
            self.assertNotIn('</script><b>', read(page))
            self.assertEqual(self.bench('table2', *SMALL, '--trajectories', other).returncode, 0)
        error = {row['method']: row['4 RMSE'] for row in self.read_csv('table2')}
        self.assertEqual(error['Other'], error['the odometry as it comes'])
        self.refused(self.bench('table2', *SMALL, '--trajectories', 'nothing'), 2, 'NAME=FOLDER')
        self.refused(self.bench('table2', *SMALL, '--trajectories', other + '/none'), 3, 'none/lot-c4-s1.txt')
        rows = read(self.out + '_other/lot-c4-s1.txt').splitlines()
        write(self.out + '_other/lot-c4-s1.txt', '\n'.join(rows[:50]) + '\n')
        self.refused(self.bench('table2', *SMALL, '--trajectories', other), 3, 'lot-c4-s1.txt: has poses for 50 of')

    def test_point_matches(self):
        rows = [f'{query} {query - 150} 0.8' for query in range(150, 300) for _ in range(6)]
        write(self.out + '_points/lot-c4-s1.txt', '\n'.join(rows) + '\n')
        result = self.bench('pr', *SMALL, '--matches', self.out + '_points')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('point matches, mean confidence', [row['method'] for row in self.read_csv('pr')])
        write(self.out + '_points/lot-c4-s1.txt', '9 3 0.5\n9 3 x\n')
        self.refused(self.bench('pr', *SMALL, '--matches', self.out + '_points'), 3, 'lot-c4-s1.txt:2')
        write(self.out + '.yaml', 'lin:\n  edge_m: 3\n')
        self.refused(self.bench('pr', *SMALL, '--baselines', self.out + '.yaml'), 2, 'other parameters')
        write(self.out + '.yaml', 'lin:\n  edge: 3\n')
        self.refused(self.bench('pr', *SMALL, '--baselines', self.out + '.yaml'), 4, '.yaml:2', "'edge_m'")

    def test_interrupted(self):
        arguments = [binaries['run'], 'bench', 'ablation', '--out', self.out, '--seeds', '5', '--threads', '1']
        bench = subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True)
        while not (os.path.isdir(self.out + '/trials') and os.listdir(self.out + '/trials')):
            time.sleep(0.05)
        bench.send_signal(signal.SIGINT)
        said, _ = bench.communicate(timeout=30)
        self.assertEqual(bench.returncode, 130)
        self.assertIn('goes on from here', said)
        self.assertFalse(os.path.exists(self.out + '/ablation.md'))

    def test_what_is_refused(self):
        self.refused(self.bench('table9'), 2, 'table9')
        self.refused(self.bench('table1'), 2, '--kitti')
        self.refused(self.bench('table2', '--methods', 'nobody'), 2, "no method 'nobody'", 'sslcd, ')
        self.refused(self.bench('table2', '--cases', 5), 2, '--cases')
        self.refused(self.bench('table2', '--seeds', 0), 2, '--seeds')
        for viewpoints in ('60', '75-60', '60-60', '60-200', 'a-b', '-15-0', '7.5-15', ''):
            self.refused(self.bench('viewpoint', *ONE, '--viewpoints=' + viewpoints), 2, '--viewpoints')
        self.refused(self.bench('viewpoint', *ONE, '--images', self.out + '/none'), 2, '--images')
        self.refused(self.bench('attempts', '--layout', self.out + '/none.json'), 2, '--layout')
        self.refused(self.bench('table1', '--kitti', self.data), 3, '--detections')
        self.refused(self.bench('table1', '--kitti', self.data, '--detections', 'dets'), 3, 'data/dets', '--detections')
        write(self.out + '/commit.txt', 'of-yore\n')
        self.refused(self.bench('table2', *SMALL), 2, 'results of commit of-yore', 'give another --out')


if __name__ == '__main__':
    main()
