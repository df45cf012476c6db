#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run graph and match: good, bad and odd input. usage: see cli_case.main"""
import json
import os

from cli_case import CliCase, call, read, write, main


class GraphMatchTest(CliCase):
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
        again = call('graph', self.out + '.g2o', '--out', self.out + '_again.g2o', '--dof', '3', '--json')
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

    def test_graph_projects_information(self):
        rows = self.square('EDGE_SE2 0 8 0 0.1 0', 'EDGE_SE2 0 4 0.1 0 0').splitlines()
        definite = '\n'.join(rows) + '\n'
        rows[3] = 'EDGE_SE2 3 4 10 0 1.5707963267948966 100 120 0 100 0 1000'  # eigenvalues -20, 220, 1000
        rows[8] = 'EDGE_SE2 0 8 0 0.1 0 0 0 0 0 0 1000'  # measures yaw only
        text = '\n'.join(rows) + '\n'

        result = self.graph(text, '--json')
        self.assertEqual(result.returncode, 0, result.stderr)
        figures = json.loads(result.stdout)
        self.assertEqual((figures['information_projected'], figures['converged']), (2, 1))
        self.assertEqual(result.stderr.count('\n'), 1, result.stderr)
        for words in ('warning', 'in.g2o: 2 of 10 information matrices are not positive definite and were projected',
                      'first: line 4', 'smallest eigenvalue -0.02 of the largest', '--strict'):
            self.assertIn(words, result.stderr)
        # What was written holds the projected matrices.
        again = call('graph', self.out + '.g2o', '--out', self.out + '_again.g2o', '--dof', '3', '--json', '--strict')
        self.assertEqual((again.returncode, again.stderr), (0, ''))
        self.assertAlmostEqual(json.loads(again.stdout)['chi2_before'], figures['chi2_after'], places=6)

        self.assertRegex(self.graph(text).stdout, r'information_projected +2\n')
        self.assertRegex(self.graph(text, '--robust').stdout, r'information_projected +2\n')
        result = self.graph(definite, '--json', '--strict')
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        self.assertEqual(json.loads(result.stdout)['information_projected'], 0)

        os.remove(self.out + '.g2o')
        self.refused(self.graph(text, '--strict'), 3, 'in.g2o:4: the information matrix is not positive definite',
                     'leave out --strict')
        self.assertFalse(os.path.exists(self.out + '.g2o'))

    def test_inputs_are_not_overwritten(self):
        write(self.data + '/in.g2o', self.square())
        os.link(self.data + '/in.g2o', self.data + '/same.g2o')
        pairs = self.strewn_pairs()
        write(self.data + '/c.yaml', 'mode: robust\n')
        for args in (('graph', self.data + '/in.g2o', '--out', self.data + '/same.g2o'),
                     ('match', pairs, '--out', pairs),
                     ('match', pairs, '--config', self.data + '/c.yaml', '--out', self.data + '/c.yaml')):
            self.refused(call(*args), 2, 'is read, and would be overwritten')
        self.assertEqual(read(self.data + '/in.g2o'), self.square())

    def test_graph_parts(self):
        result = self.graph(self.square() + 'EDGE_SE2 20 21 1 0 0 1 0 0 1 0 1\n')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn('2 parts that no edge joins', result.stderr)

    def test_bad_graphs(self):
        one, two = 'VERTEX_SE2 0 0 0 0\n', 'VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n'
        edge = 'EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n'
        for text, *messages in (
                ('', 'in.g2o: no EDGE'), (one, 'nothing to optimise'), (one + edge, 'in.g2o:2', 'vertex 1 has no VERTEX'),
                (two + one + edge, 'in.g2o:3', 'vertex 0 is a duplicate of line'),
                (two + 'EDGE_SE2 0 1 1 0 nan 1 0 0 1 0 1\n', 'in.g2o:3', 'not finite'),
                (two + 'EDGE_SE2 0 1 1 0 0 1 0 0 nan 0 1\n', 'in.g2o:3', 'not finite'),
                (two + 'EDGE_SE2 0 1 1 0 0 1 0 0 -1 0 1\n', 'in.g2o:3', 'negative diagonal entry'),
                (two + 'EDGE_SE2 0 1 1 0 0 0 0 0 0 0 0\n', 'in.g2o:3', 'no positive diagonal entry'),
                (two + 'EDGE_SE2 0 1 1 0\n', 'in.g2o:3', 'expected 11 fields')):
            self.refused(self.graph(text), 3, *messages)
            self.assertFalse(os.path.exists(self.out + '.g2o'))
        self.refused(call('graph', self.data + '/absent.g2o', '--out', self.out + '.g2o'), 3, 'absent.g2o')
        self.assertEqual(call('graph', self.data + '/in.g2o').returncode, 2)
        self.assertEqual(self.graph(two + edge, '--dof', '5').returncode, 2)
        result = call('graph', self.data + '/in.g2o', '--out', self.data + '/odometry.txt/out.g2o')
        self.assertEqual(result.returncode, 1, result.stderr)

    # output

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
        self.assertEqual(rows[0], 'pair,decision,yaw_rad,tx,ty,tz,score,second_score,matches,looked_at,left_out,ms'.split(','))
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
        strict = call('match', self.strewn_pairs(), '--set', 'decision.min_margin=900')
        self.assertIn('5,ambiguous', strict.stdout)
        self.assertEqual(call('match', self.strewn_pairs(), '--mode', 'paper').returncode, 0)
        unknown = call('match', self.strewn_pairs(), '--set', 'decision.min_margn=9')
        self.assertEqual(unknown.returncode, 4)
        self.assertIn("did you mean 'min_margin'", unknown.stderr)

    def test_match_reads_one_map_for_many_queries(self):
        spots = [(0, 0), (7, 1), (13, -4), (3, 12), (-9, 5), (-4, -11), (18, 9), (-15, -3)]
        rows = [f'MAP {len(spots)}']
        rows += [f'G {k} {k % 3} {x + 10} {y + 20} 0.5' for k, (x, y) in enumerate(spots)]
        for pair in (5, 7):
            rows += [f'PAIR {pair} made/up {len(spots)} 0 1.5707963 10 20 0.5']
            rows += [f'L -1 {k % 3} {y} {-x} 0' for k, (x, y) in enumerate(spots)]
        whole = call('match', self.strewn_pairs()).stdout.splitlines()
        result = call('match', self.pairs(*rows, 'PAIR 6 empty 0 0 0 0 0 0'), '--threads', 2)
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        answers = [row.rsplit(',', 1)[0].split(',') for row in result.stdout.splitlines()]
        self.assertEqual([row[0] for row in answers], ['pair', '5', '7', '6'])
        self.assertEqual(answers[1], whole[1].rsplit(',', 1)[0].split(','))
        self.assertEqual(answers[1][1:], answers[2][1:])
        self.assertGreater(int(answers[1][answers[0].index('looked_at')]), 10)
        self.assertEqual(call('match', self.pairs(*rows), '--mode', 'paper').returncode, 0)
        cut = call('match', self.pairs(*rows[:5], *rows[9:]))
        self.assertEqual(cut.returncode, 3)
        self.assertIn('pairs.txt:1: the map announces 8 G rows, but has 4', cut.stderr)

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
        refuse(3, self.pairs(pair, 'Q 0 0 1 2 3'), "pairs.txt:2: a row starts with MAP, PAIR, L or G, not with 'Q'")
        refuse(3, self.data, 'is a folder')
        self.assertEqual(call('match').returncode, 2)
        self.assertEqual(call('match', self.strewn_pairs(), '--threads', '0').returncode, 2)
        unwritable = call('match', self.strewn_pairs(), '--out', self.data + '/no/such/folder.csv')
        self.assertEqual(unwritable.returncode, 1, unwritable.stderr)


if __name__ == '__main__':
    main()
