#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The page of sslcd_run report in a real browser, with the demo's sequence.

usage: report_page_test.py SSLCD_RUN SSLCD_SIM FOLDER [unittest arguments]     screenshots: FOLDER"""
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

from browser import Browser, find_chromium

EVIL = '</script><script>window.evil = 1</script><img src=x onerror="window.evil = 1">'
SIZES = ((1920, 1080), (390, 844))


def call(*arguments, cwd=None):
    subprocess.run([*map(str, arguments)], check=True, capture_output=True, timeout=60, cwd=cwd)


def write_png(path, width, height):
    """Stripes of grey."""
    def chunk(kind, content):
        return struct.pack('>I', len(content)) + kind + content + struct.pack('>I', zlib.crc32(kind + content))
    rows = b'\0' + bytes(16 * (x // 40 % 16) for x in range(width))
    with open(path, 'wb') as file:
        file.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)) +
                   chunk(b'IDAT', zlib.compress(rows * height)) + chunk(b'IEND', b''))


class ReportPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix='sslcd_report_')
        root = cls.folder.name
        call(SIM, 'halv', '--case', 1, '--seed', 7, '--out', root + '/halv')
        # A label is text of the user's, and here looks like markup.
        with open(root + '/halv/detections.txt') as file:
            rows = [row.split() for row in file]
        cls.label = EVIL.replace(' ', '_')
        for row in rows:
            row[2] = cls.label if row[2] == 'Van' else row[2]
        with open(root + '/halv/detections.txt', 'w') as file:
            file.writelines(' '.join(row) + '\n' for row in rows)
        cls.images = root + '/halv/left'  # one picture for all frames; the colours are those of colours.npy
        os.mkdir(cls.images)
        write_png(root + '/image.png', 1280, 720)
        for frame in range(max(int(row[0]) for row in rows) + 1):
            os.link(root + '/image.png', f'{cls.images}/{frame:06}.png')
        cls.run_folder = root + '/' + 'run'
        call(RUN, 'run', 'halv', '--groundtruth', 'groundtruth.txt', '--out', cls.run_folder, '--report', cwd=root)
        cls.browser = Browser(find_chromium())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def setUp(self):
        self.page = self.browser
        self.page.problems.clear()

    def tearDown(self):
        self.assertEqual(self.page.problems, [], 'errors of the console')

    def open(self, size=(1200, 680)):
        self.page.open(self.run_folder + '/report.html', *size)

    def colours(self):
        """The number of different colours on the map."""
        return self.page.run('''(() => { report.drawNow(); const from = document.getElementById("scene"), to = document.createElement("canvas");
            to.width = to.height = 200; const context = to.getContext("2d"); context.drawImage(from, 0, 0, 200, 200);
            return new Set(new Uint32Array(context.getImageData(0, 0, 200, 200).data.buffer)).size; })()''')

    def camera(self):
        return self.page.run('report.world.camera.position.toArray()')

    def column(self, index):
        return self.page.run(f'[...document.querySelectorAll("#loops tbody tr")].map((row) => row.cells[{index}].textContent)')

    def test_both_sizes_show_a_map_and_fit(self):
        for size in SIZES:
            with self.subTest(size=size):
                self.open(size)
                self.assertGreater(self.colours(), 20)
                self.assertLessEqual(self.page.run('document.documentElement.scrollWidth'), size[0], 'nothing sticks out')
                self.page.screenshot(f'{SHOTS}/report_{size[0]}x{size[1]}.png')
                self.page.run('document.getElementById("theme").click()')
                self.assertGreater(self.colours(), 20)
                self.page.screenshot(f'{SHOTS}/report_{size[0]}x{size[1]}_other_theme.png', whole=size[0] < 600)

    def test_the_slider_replays_the_run(self):
        self.open()
        state = 'const s = document.getElementById("time"); s.value = 100; s.dispatchEvent(new Event("input"));'
        seen = '''report.world.scene.children.flatMap((group) => group.children).filter((mesh) => mesh.isInstancedMesh)
            .reduce((sum, mesh) => sum + (mesh.visible ? mesh.count : 0), 0)'''
        all_objects, at_end = self.page.run(seen), self.page.run('document.getElementById("clock").textContent')
        self.page.run(f'(() => {{ {state} }})()')
        self.assertEqual(self.page.run('report.state().row'), 100)
        self.assertNotEqual(self.page.run('document.getElementById("clock").textContent'), at_end)
        self.assertTrue(0 < self.page.run(seen) < all_objects)
        self.page.run('document.getElementById("play").click()')
        self.page.wait('report.state().row > 105')

        # paths end at the camera
        off = self.page.run('''(() => { const run = report.data.runs[0], slider = document.getElementById("time"); let most = 0, whole = 0;
            const lines = report.world.scene.children.flatMap((group) => group.children).filter((mesh) => mesh.userData.segments);
            for (const row of [1, 2, 77, 78, 300, 301, 250, Number(slider.max)]) {
              report.setRow(row);
              [run.odometry, run.corrected, run.truth].forEach((flat, i) => {
                const end = lines[i].geometry.attributes.position.array, last = 3 * (lines[i].geometry.drawRange.count - 1);
                for (let k = 0; k < 3; ++k) most = Math.max(most, Math.abs(end[last + k] - flat[3 * row + k] / 1000));
              });
            }
            for (const { geometry, userData } of lines)  // what was cut is whole again
              userData.segments.forEach(([from, to], i) => { whole = Math.max(whole, Math.abs(geometry.attributes.position.array[6 * i + 3] - userData.at[to].x)); });
            return [lines.length, most, whole]; })()''')
        self.assertEqual(off[0], 3)
        self.assertLess(max(off[1:]), 1e-3)

    def test_a_click_on_a_loop_flies_there(self):
        self.open()
        before = self.camera()
        self.page.run('document.querySelector("#loops tbody tr button").click()')
        self.page.wait(f'JSON.stringify(report.world.camera.position.toArray()) !== {json.dumps(json.dumps(before))}')
        self.assertIn('objects matched', self.page.run('document.getElementById("details").textContent'))
        self.assertEqual(self.page.run('document.querySelectorAll("#loops tr.chosen").length'), 1)
        self.page.wait('[...document.querySelectorAll("#details img")].every((image) => image.complete)')
        sizes = self.page.run('[...document.querySelectorAll("#details img")].map((image) => Math.max(image.naturalWidth, image.naturalHeight))')
        self.assertGreaterEqual(len(sizes), 2, 'the objects in the images of both cameras')
        self.assertTrue(all(8 <= size <= 112 for size in sizes), sizes)
        self.page.screenshot(SHOTS + '/report_loop.png')

    def test_images_are_those_of_the_run(self):
        other, hidden = self.run_folder + '/other.html', self.images + '_moved'
        call(RUN, 'report', self.run_folder, '--out', other, '--no-images')
        with open(other) as file:
            self.assertIn('"images":[]', file.read())
        call(RUN, 'report', self.run_folder, '--out', other, cwd='/')  # images were named from another folder
        with open(other) as file:
            self.assertNotIn('"images":[]', file.read())
        os.rename(self.images, hidden)
        os.mkdir(self.images)
        try:  # another folder in its place
            write_png(self.images + '/000000.png', 1280, 720)
            call(RUN, 'report', self.run_folder, '--out', other)
        finally:
            shutil.rmtree(self.images)
            os.rename(hidden, self.images)
        self.page.open(other, 1200, 680)
        self.assertIn('has changed', self.page.run('document.getElementById("notes").textContent'))
        self.assertEqual(self.page.run('report.data.runs[0].images.length'), 0)

    def test_panels_of_check_and_recall(self):
        self.open()
        with open(self.run_folder + '/run.json') as file:
            check = json.load(file)['check']
        shown = self.page.run('[...document.querySelectorAll("#check tr")].map((row) => row.textContent)')
        self.assertGreater(len(check), 10)
        self.assertEqual(shown, [one['check'] + one['result'] + one['text'] for one in check if 'mistake' not in one])

        # and of the true poses
        bins = self.page.run('report.data.runs[0].recall')
        with open(self.run_folder + '/metrics.json') as file:
            metrics = json.load(file)
        self.assertEqual(sum(loops for _, _, loops, _ in bins), metrics['loops'])
        self.assertEqual(sum(loops - right for _, _, loops, right in bins), metrics['loops_wrong'])
        self.assertGreater(sum(places for places, _, _, _ in bins), 10)
        shown = self.page.run('Chart.getChart("recall_chart").data.datasets[0].data')
        self.assertEqual(shown, [found / places if places else None for places, found, _, _ in bins])

    def test_page_of_a_benchmark(self):
        page = self.folder.name + '/bench.html'
        call(RUN, 'bench', 'pr', '--seeds', 1, '--cases', 4, '--methods', 'sslcd,one_look', '--out', self.folder.name + '/bench', '--report', page)
        for size in SIZES:
            self.page.open(page, *size, ready='document.querySelector("#tables table")')
            self.assertLessEqual(self.page.run('document.documentElement.scrollWidth'), size[0], 'nothing sticks out')
            self.page.screenshot(f'{SHOTS}/bench_{size[0]}x{size[1]}.png')
        lines = self.page.run('Chart.getChart("pr_chart").data.datasets.map((each) => [each.label, each.data.length])')
        self.assertEqual([name for name, _ in lines], ['sslcd', 'one_look'])
        self.assertGreater(min(count for _, count in lines), 1)
        column = '[...document.querySelectorAll("#tables tbody tr")].map((row) => Number(row.cells[3].textContent))'
        self.page.run('document.querySelectorAll("#tables thead button")[3].click()')
        self.assertEqual(self.page.run(column), [0.5, 1])
        self.page.run('document.querySelectorAll("#tables thead button")[3].click()')
        self.assertEqual(self.page.run(column), [1, 0.5])

    def test_views(self):
        self.open()
        for view in ('above', 'driver'):
            before = self.camera()
            self.page.run(f'document.querySelector("[data-view={view}]").click()')
            self.assertNotEqual(self.camera(), before)
            self.assertGreater(self.colours(), 10)
        self.page.screenshot(SHOTS + '/report_first_person.png')

    def test_the_table_sorts(self):
        self.open()
        sort = 'document.querySelectorAll("#loops thead button")[2].click()'
        self.page.run(sort)
        angles = [float(text) for text in self.column(2)]
        self.assertEqual(angles, sorted(angles))
        self.page.run(sort)
        self.assertEqual([float(text) for text in self.column(2)], angles[::-1])
        with open(self.run_folder + '/loops.csv') as file:
            self.assertEqual(len(angles), sum(',accepted,' in row for row in file))
        self.page.run('(() => { const s = document.getElementById("decision"); s.value = "none"; s.onchange(); })()')
        self.assertEqual(set(self.column(7)), {'none'})

    def test_figures_are_those_of_the_files(self):
        self.open()
        rows = dict(self.page.run('[...document.querySelectorAll("#summary tr")].map((row) => [row.cells[0].textContent, row.cells[1].textContent])'))
        with open(self.run_folder + '/metrics.json') as file:
            printed = re.findall(r'"([^"]+)":([^,\n}]+)', file.read())
        self.assertGreater(len(printed), 20)
        for name, value in printed:
            self.assertEqual(rows[name], '-' if value == 'null' else value)
        rms = self.page.run('''(() => { const run = report.data.runs[0]; let sum = 0, count = 0;
            for (let i = 0; i < run.corrected.length; ++i) { sum += ((run.corrected[i] - run.truth[i]) / 1000) ** 2; count += i % 3 === 0; }
            return Math.sqrt(sum / count); })()''')
        self.assertAlmostEqual(rms, float(dict(printed)['ate_se3_rmse_m']), places=3)
        self.assertGreater(self.page.run('Chart.getChart("error_chart").data.datasets[3].data.length'), 100)

    def test_labels_stay_text(self):
        self.open()
        self.assertIsNone(self.page.run('window.evil'))
        self.assertIn(self.label, self.page.run('document.getElementById("legend").textContent'))


if __name__ == '__main__':
    if find_chromium() is None:
        print('skipped: no Chromium (package chromium)')
        sys.exit(77)
    RUN, SIM, SHOTS = map(os.path.abspath, sys.argv[1:4])
    os.makedirs(SHOTS, exist_ok=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
