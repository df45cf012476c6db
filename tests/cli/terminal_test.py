#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What people see: examples, progress, loops as they happen, why there are none, JSON. usage: see cli_case.main"""
import json
import os
import pty
import re
import shlex
import subprocess

from cli_case import CliCase, binaries, call, read, write, main


def helps(words=()):
    """The help of the program and of all subcommands: {(): ..., ('map',): ..., ('map', 'info'): ..., ...}"""
    found = {words: call(*words, '--help').stdout}
    parts = found[words].split('Subcommands:\n')[1:]
    for name in re.findall(r'^  (\S+)', parts[0].split('\n\n')[0], re.M) if parts else []:
        found.update(helps((*words, name)))
    return found


class HelpTest(CliCase):
    def test_all_help_has_examples_that_parse(self):
        texts = helps()
        self.assertLessEqual({('run',), ('compare',), ('version',)}, set(texts))
        for words, text in texts.items():
            self.assertRegex(text, r'\nExamples:\n  sslcd_run ', words)
            lines = text.split('\nExamples:\n')[1].split('\n\n')[0].splitlines()
            self.assertLessEqual(len(lines), 4, words)
            for line in lines:
                with self.subTest(example=line):
                    self.parses(shlex.split(line)[1:], words, texts)

    def parses(self, row, words, texts):
        self.assertEqual(tuple(row[:len(words)]), words, 'an example of its own command')
        of = max((name for name in texts if tuple(row[:len(name)]) == name), key=len)
        listed = set(re.findall(r'(?<![\w-])--?[a-z][a-z-]*', texts[of].split('\nExamples:')[0]))
        self.assertEqual({word for word in row if word.startswith('-')} - listed, set())
        result = call(*row, '--help')  # checks the values of the options, and runs nothing
        self.assertEqual((result.returncode, result.stderr), (0, ''))


class LoopsTest(CliCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.lot = cls.root + '/lot'
        cls.fast = ('--no-check', '--set', 'refine.enabled=false')
        subprocess.run([binaries['sim'], 'halv', '--out', cls.lot, '--seed', '1'], check=True, capture_output=True)

    def terminal(self, *args):
        """What a run shows on a terminal, and what it prints into a pipe."""
        own, other = pty.openpty()
        process = subprocess.Popen([binaries['run'], *map(str, args)], stdout=subprocess.PIPE, stderr=other)
        os.close(other)
        shown = b''
        while True:
            try:
                shown += os.read(own, 65536)
            except OSError:  # the program has ended
                break
        os.close(own)
        printed = process.communicate()[0].decode()
        self.assertEqual(process.returncode, 0)
        return shown.decode(), printed

    def test_loops_are_printed_as_they_happen(self):
        shown, printed = self.terminal('run', self.lot, '--out', self.out, *self.fast, '--max-frames', 460)
        lines = [line for line in printed.splitlines() if line.startswith('loop: ')]
        for line in lines:
            self.assertRegex(line, r'^loop: frame \d+ to \d+, viewpoint change \d+ deg, \d+ objects, probability (> 0.9999|0.\d{4})$')
        rows = [row.split(',') for row in read(self.out + '/loops.csv').splitlines()]
        accepted = {(row[0], row[1]) for row in rows if row[2] == 'accepted'}
        self.assertGreater(len(lines), 5)
        self.assertGreater(len({tuple(re.findall(r'\d+', line)[:2]) for line in lines} & accepted), 5)
        self.assertNotIn('no loop was found', printed)
        self.assertLess(printed.index('loop: '), printed.index('loops accepted'))
        steps = shown.split('\r\x1b[K')
        self.assertRegex(shown, r'frame 460/460, \d+ frames/s ')
        self.assertTrue(any(re.fullmatch(r'frame \d+/460, \d+ frames/s, \d+ s left ', step) for step in steps), steps)
        self.assertEqual(steps[-1], '', 'the line is cleared at the end')

    def test_quiet_json_and_verbose(self):
        for option in ('--quiet', '--json'):
            shown, printed = self.terminal('run', self.lot, '--out', self.out, *self.fast, '--max-frames', 400, '--force', option)
            self.assertEqual(shown, '')
            self.assertNotIn('loop: ', printed)
            if option == '--json':
                self.assertIn('loops', json.loads(printed))
        result = call('run', self.lot, '--out', self.out, '--force', *self.fast, '--max-frames', 400, '--verbose')
        self.assertRegex(result.stdout, r'\nno loop: frame \d+ to \d+, .*, \d+ objects, .*; chance explains the best pose\n')
        self.assertNotIn('\r', result.stdout + result.stderr)

    def test_a_map_names_the_session_of_a_frame(self):
        site = self.data + '/site.db'
        first = call('run', self.lot, '--map', site, '--session', 'mon', *self.fast, '--max-frames', 370)
        self.assertEqual(first.returncode, 0, first.stderr)
        second = call('run', self.lot, '--map', site, '--session', 'tue', *self.fast, '--max-frames', 160)
        self.assertRegex(second.stdout, r"\nloop: frame \d+ to \d+ of 'mon', ")
        frames = [int(n) for n in re.findall(r'\nloop: frame (\d+) to', second.stdout)]
        self.assertTrue(frames and max(frames) < 160, frames)

    def test_why_there_are_no_loops(self):
        result = call('run', self.lot, '--out', self.out, *self.fast, '--max-frames', 400)
        table = dict(re.split(r'  +', line.strip(), maxsplit=1)
                     for line in result.stdout.split('no loop was found\n')[1].split('\n\n')[0].splitlines())
        landmarks = re.search(r'\n  landmarks +(\d+)\n', result.stdout)[1]
        self.assertEqual(table['objects in the map'], landmarks)
        self.assertRegex(table['odometry comes back within 10 m'], r'^(never|once|\d+ times); nearest: [\d.]+ m, frame \d+ to \d+, path of \d+ m between$')
        counts = [int(value) for name, value in table.items() if name.startswith(('too few objects', 'refused: '))]
        self.assertEqual(sum(counts), int(table['searches']))
        self.assertRegex(table['nearest miss'], r'^frame \d+ to \d+, .*, probability [\d.]+; \w.*$')
        off = call('run', self.data, '--out', self.out, '--force', '--set', 'loop.enabled=false').stdout
        self.assertIn('no loop was looked for (loop.enabled: false)', off)


class JsonTest(CliCase):
    def test_version(self):
        version = json.loads(call('version', '--json').stdout)
        self.assertEqual('sslcd {version} (commit {commit})\n'.format(**version), call('version').stdout)

    def test_compare(self):
        self.run_data()
        other = self.out + '_other'
        call('run', self.data, '--out', other, '--max-frames', 20, '--set', 'ba.max_iterations=3')
        compared = json.loads(call('compare', self.out, other, '--json').stdout)
        self.assertEqual((compared['runs'], compared['results']['frames']), ([self.out, other], [40, 20]))
        metrics = json.loads(read(self.out + '/metrics.json'))
        self.assertEqual(compared['results']['ate_se3_rmse_m'][0], metrics['ate_se3_rmse_m'], 'all digits')
        self.assertEqual(list(compared['differences']), ['ba.max_iterations'])

    def test_match(self):
        pairs = self.data + '/pairs.txt'
        write(pairs, 'PAIR 3 one 2 2 0 0 0 0\nL 1 1 0 0 0\nL 2 1 5 0 0\nG 1 1 0 0 0\nG 2 1 5 0 0\n')
        rows = call('match', pairs)
        self.assertEqual(rows.returncode, 0, rows.stderr)
        header, row = (line.split(',') for line in rows.stdout.splitlines())
        answer, = json.loads(call('match', pairs, '--json').stdout)
        self.assertEqual({'pair', 'decision', 'yaw_rad', 'score', 'matches', 'ms'} - set(answer), set())
        self.assertEqual((str(answer['pair']), answer['decision']), (row[0], row[1]))
        self.assertLess(abs(answer['score'] - float(row[header.index('score')])), 1e-3)


if __name__ == '__main__':
    main()
