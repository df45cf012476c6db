#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the pictures of README.md: docs/images/opposite_loop.svg and report.jpg. Needs Embree and Chromium; five
minutes of processor time.
usage: scripts/readme_pictures.py [BUILD [DRIVE]]     BUILD: build/release; DRIVE: the rendered sequence, if it is there"""
import base64
import csv
import os
import subprocess
import sys
import tempfile
import time

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..')
sys.path.insert(0, os.path.join(ROOT, 'tests/browser'))
from browser import Browser, find_chromium  # noqa: E402

DRIVE = ['halv', '--case', '1', '--seed', '7', '--render', '--render-scale', '0.5', '--threads', '2']


def best_loop(run):
    """The query frame of the loop of most matches from the opposite side."""
    with open(run + '/loops.csv', encoding='utf-8') as file:
        loops = [row for row in csv.DictReader(file) if row['decision'] == 'accepted']
    return max((row for row in loops if float(row['viewpoint_change_deg']) > 170), key=lambda row: int(row['matches']))['query_frame']


def picture(report, frame, path):
    browser = Browser(find_chromium() or sys.exit('no Chromium: install the package chromium'))
    try:
        browser.open(report, 1300, 800)
        browser.run('document.getElementById("more").click()')
        browser.run(f'[...document.querySelectorAll("#loops td button")].find((b) => b.textContent === "{frame}").click()')
        time.sleep(2)  # the camera flies there
        shot = browser.call('Page.captureScreenshot', format='jpeg', quality=85)
    finally:
        browser.close()
    with open(path, 'wb') as file:
        file.write(base64.b64decode(shot['data']))


def main():
    build = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, 'build/release')
    tool, images = build + '/apps/sslcd_run', os.path.join(ROOT, 'docs/images/')
    with tempfile.TemporaryDirectory() as folder:
        drive, run = sys.argv[2] if len(sys.argv) > 2 else folder + '/car_park', folder + '/run'
        if len(sys.argv) <= 2:
            subprocess.run([build + '/apps/sslcd_sim', *DRIVE, '--out', drive], check=True)
        subprocess.run([tool, 'run', drive, '--groundtruth', 'groundtruth.txt', '--out', run, '--report', '--quiet'], check=True)
        frame = best_loop(run)
        subprocess.run([tool, 'draw', run, '--loop', frame, '--out', images + 'opposite_loop.svg'], check=True)
        picture(run + '/report.html', frame, images + 'report.jpg')


if __name__ == '__main__':
    main()
