#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures a page of sslcd_run report in Chromium with software rendering, 1920x1080: time from the start of loading to
the first frame of the map, and time of a step of the time slider with its frame.

usage: report_speed.py REPORT.html [REPETITIONS]     prints size, medians and maxima"""
import os
import statistics
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../tests/browser'))
from browser import Browser, find_chromium  # noqa: E402

# The charts are drawn after the map's first frame, and the first step would wait for them.
READY = '''new Promise((done) => {
  const wait = () => (Chart.getChart("timing_chart") ? requestIdleCallback(done) : setTimeout(wait, 20));
  wait();
})'''
# Reading a pixel waits until the frame is done.
STEPS = '''(() => {
  const slider = document.getElementById("time"), gl = report.world.renderer.getContext(), times = [], pixel = new Uint8Array(4);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  for (let i = 1; i <= 40; ++i) {
    const start = performance.now();
    slider.value = Math.round(slider.max * i / 40);
    slider.dispatchEvent(new Event("input"));
    report.drawNow();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    times.push(performance.now() - start);
  }
  return times;
})()'''


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    program = find_chromium() or sys.exit('no Chromium: install the package chromium')
    first, steps = [], []
    for _ in range(int(sys.argv[2]) if len(sys.argv) == 3 else 5):
        browser = Browser(program)
        try:
            browser.open(sys.argv[1], 1920, 1080)
            first.append(browser.run('report.world.first_frame_ms'))
            browser.run(READY)
            steps += browser.run(STEPS)
        finally:
            browser.close()
    print(f'size         {os.path.getsize(sys.argv[1]) / 1e6:.2f} MB')
    for name, times in (('first frame', first), ('slider step', steps)):
        print(f'{name}  {statistics.median(times):.0f} ms (median), {max(times):.0f} ms (longest)')


if __name__ == '__main__':
    main()
