#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run draw, report and compare: what they write, and what goes wrong. usage: see cli_case.main"""
import json
import os

from cli_case import CliCase, call, read, write, main


class DrawTest(CliCase):
    def setUp(self):
        super().setUp()
        self.run_data('--groundtruth', 'groundtruth.txt', '--quiet')
        self.picture = self.data + '/map.svg'

    def not_drawn(self, result, code, *messages):
        self.assertEqual((result.returncode, os.path.exists(self.picture)), (code, False), result.stderr)
        for message in messages:
            self.assertIn(message, result.stderr)

    def test_pictures(self):
        self.assertEqual(call('draw', self.out, '--out', self.picture).stdout, f'wrote {self.picture}\n')
        for word in ('odometry', 'corrected', 'ground truth', 'Car', ' m</text>'):
            self.assertIn(word, read(self.picture))
        png = self.data + '/map.png'
        self.assertEqual(call('draw', self.out, '--out', png, '--size', 300, '--before-after').returncode, 0)
        with open(png, 'rb') as file:
            header = file.read(24)
        self.assertEqual((header[:4], int.from_bytes(header[16:20], 'big')), (b'\x89PNG', 600))

    def test_json(self):
        shown = json.loads(call('draw', self.out, '--out', self.picture, '--loops', 0, '--json').stdout)
        objects = sum(each['state'] == 'confirmed' for each in json.loads(read(self.out + '/map.json'))['objects'])
        self.assertEqual(shown, {'run': self.out, 'frames': 40, 'objects': objects, 'loops': 0,
                                 'written': [{'path': self.picture, 'bytes': os.path.getsize(self.picture)}]})
        self.assertEqual(call('draw', self.data, '--out', self.picture, '--json').stdout, '', 'nothing was drawn')

    def test_what_cannot_be_drawn(self):
        draw = ('draw', self.out, '--out', self.picture)
        self.not_drawn(call('draw', self.data, '--out', self.picture), 3, 'holds no map.json')
        self.not_drawn(call(*draw, '--loop', 3), 2, 'no accepted loop')
        self.not_drawn(call(*draw[:3], self.data + '/map.gif'), 2, 'ends with .svg or .png')
        self.not_drawn(call(*draw, '--groundtruth', self.data + '/none.txt'), 3, 'none.txt')
        write(self.out + '/map.json', read(self.out + '/map.json') + ' ')
        self.not_drawn(call(*draw), 3, 'map.json: is not the file')


class CompareTest(CliCase):
    def test_results_and_what_differs(self):
        self.run_data()
        other = self.out + '_other'
        self.assertEqual(call('run', self.data, '--out', other, '--max-frames', 20, '--set', 'ba.max_iterations=3').returncode, 0)
        result = call('compare', self.out, other)
        self.assertEqual(result.returncode, 0, result.stderr)
        results, differs = [{line.split()[0]: line.split()[1:] for line in part.splitlines() if line.strip()}
                            for part in result.stdout.split('what differs')]
        self.assertEqual((results['run'], results['frames']), ([self.out, other], ['40', '20']))
        self.assertIn('ate_se3_rmse_m', results)
        self.assertEqual(set(differs), {'run', 'ba.max_iterations'})
        self.assertEqual(differs['ba.max_iterations'][1], '3')
        self.assertIn('the same configuration', call('compare', self.out, self.out).stdout)

    def test_what_cannot_be_compared(self):
        self.run_data()
        result = call('compare', self.out, self.data)
        self.assertEqual((result.returncode, result.stdout), (3, ''))
        self.assertIn('metrics.json', result.stderr)
        write(self.out + '/metrics.json', '{}')
        result = call('compare', self.out)
        self.assertEqual((result.returncode, result.stdout), (3, ''))
        self.assertIn('metrics.json: is not the file', result.stderr)


class ReportTest(CliCase):
    def report(self, *args):
        result = call('report', *args)
        if 'libjs-three' in result.stderr:
            self.skipTest('skipped: built without three.js and Chart.js')
        return result

    def test_pages(self):
        truth = self.data + '/true.txt'
        os.rename(self.data + '/groundtruth.txt', truth)
        self.run_data('--report')
        page = self.out + '/report.html'
        self.assertEqual(self.report(self.out).stdout, f'wrote {page}\n')
        one = read(page)
        self.assertIn('<title>data - sslcd</title>', one)
        both = self.data + '/both.html'
        self.assertEqual(self.report(self.out, self.out + '/', '--out', both, '--groundtruth', truth).returncode, 0)
        self.assertIn('<title>2 runs - sslcd</title>', read(both))
        self.assertTrue('"truth":null' in one and '"truth":null' not in read(both))
        self.assertEqual(self.run_data('--report').returncode, 0, 'the page is no other run')
        judged = self.data + '/judged.html'  # with the figures that eval prints
        result = call('eval', self.out, '--groundtruth', truth, '--report', judged, '--json')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('ate_se3_rmse_m', result.stdout)
        self.assertIn(json.dumps(result.stdout).replace('<', '\\u003c'), read(judged))

    def test_inputs_are_not_overwritten(self):
        self.run_data()
        truth, loops, detections = self.data + '/groundtruth.txt', self.out + '/loops.csv', self.data + '/detections.txt'
        before = [read(path) for path in (truth, loops, detections)]
        evaluate = ('eval', self.out, '--groundtruth', truth, '--report')
        self.report(self.out, '--out', self.data + '/page.html')
        for args in ((*evaluate, truth), (*evaluate, loops), (*evaluate, detections), ('report', self.out, '--out', loops),
                     ('report', self.out, '--groundtruth', truth, '--out', truth), ('report', self.out, '--out', detections)):
            result = call(*args)
            self.assertEqual((result.returncode, result.stdout), (2, ''), args)
            self.assertIn('name another place with ' + ('--report' if args[0] == 'eval' else '--out'), result.stderr)
        self.assertEqual([read(path) for path in (truth, loops, detections)], before)
        page = self.data + '/eval.html'
        self.assertIn(f'wrote {page}\n', call(*evaluate, page, '--no-images').stdout)

    def test_json(self):
        self.run_data()
        page = self.data + '/page.html'
        shown = json.loads(self.report(self.out, self.out, '--out', page, '--json').stdout)
        self.assertEqual([(run['run'], run['frames']) for run in shown['runs']], [(self.out, 40)] * 2)
        self.assertEqual(shown['runs'][0]['attempts'], len(read(self.out + '/loops.csv').splitlines()) - 1)
        self.assertEqual(shown['written'], [{'path': page, 'bytes': os.path.getsize(page)}])

    def test_what_has_no_page(self):
        self.run_data()
        page = self.data + '/page.html'
        for folder, message in ((self.data, 'holds no map.json'), (self.root + '/none', 'holds no map.json')):
            result = self.report(folder, '--out', page)
            self.assertEqual((result.returncode, os.path.exists(page)), (3, False))
            self.assertIn(message, result.stderr)
        self.assertEqual(self.report(self.out, '--out', self.root + '/none/page.html').returncode, 1)
        write(self.out + '/loops.csv', read(self.out + '/loops.csv').replace('none', 'accepted') + '\n')
        result = self.report(self.out, '--out', page)
        self.assertEqual((result.returncode, os.path.exists(page)), (3, False))
        self.assertIn('loops.csv: is not the file', result.stderr)


if __name__ == '__main__':
    main()
