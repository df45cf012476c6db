#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the results of `sslcd_run bench` in a folder: precision-recall curves, recall over the change of viewpoint, and
the errors of all loops over it (the paper's figures of the same kind).

usage: draw_bench.py FOLDER OUT_FOLDER      standard library only; writes pr.svg, viewpoint.svg, viewpoint_images.svg
                                            and loops.svg, as far as their tables exist
"""
import csv
import os
import sys

COLOURS = ['#1f6feb', '#d1495b', '#2a9d4a', '#b07aa1', '#e8a33d', '#5b5b5b', '#17becf', '#8c564b', '#111111']
WIDTH, HEIGHT, LEFT, BOTTOM, TOP = 420, 300, 48, 40, 28


class Plot:
    """One diagram: data to pixels, axes, curves and points."""

    def __init__(self, x_offset, title, x_label, y_label, x_max, y_max, x_step, y_step):
        self.left, self.x_max, self.y_max = x_offset + LEFT, x_max, y_max
        self.items = [f'<text x="{self.x(x_max / 2):.0f}" y="16" text-anchor="middle" font-weight="bold">{title}</text>',
                      f'<text x="{self.x(x_max / 2):.0f}" y="{HEIGHT - 6}" text-anchor="middle">{x_label}</text>',
                      f'<text transform="translate({x_offset + 12},{self.y(y_max / 2):.0f}) rotate(-90)" '
                      f'text-anchor="middle">{y_label}</text>']
        for value in steps(x_max, x_step):
            self.items.append(f'<line x1="{self.x(value):.1f}" x2="{self.x(value):.1f}" y1="{self.y(0):.1f}" '
                              f'y2="{self.y(y_max):.1f}" stroke="#ddd"/><text x="{self.x(value):.1f}" '
                              f'y="{self.y(0) + 14:.1f}" text-anchor="middle">{value:g}</text>')
        for value in steps(y_max, y_step):
            self.items.append(f'<line x1="{self.x(0):.1f}" x2="{self.x(x_max):.1f}" y1="{self.y(value):.1f}" '
                              f'y2="{self.y(value):.1f}" stroke="#ddd"/><text x="{self.x(0) - 4:.1f}" '
                              f'y="{self.y(value) + 4:.1f}" text-anchor="end">{value:g}</text>')

    def x(self, value):
        return self.left + (WIDTH - LEFT - 12) * min(value, self.x_max) / self.x_max

    def y(self, value):
        return HEIGHT - BOTTOM - (HEIGHT - BOTTOM - TOP) * min(value, self.y_max) / self.y_max

    def curve(self, points, colour):
        path = ' '.join(f'{self.x(a):.1f},{self.y(b):.1f}' for a, b in points)
        self.items.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.8"/>')

    def bar(self, x, low, high, colour):
        self.items.append(f'<line x1="{self.x(x):.1f}" x2="{self.x(x):.1f}" y1="{self.y(low):.1f}" '
                          f'y2="{self.y(high):.1f}" stroke="{colour}" stroke-opacity=".35"/>')

    def dots(self, points, colour):
        path = ''.join(f'M{self.x(a):.0f} {self.y(b):.1f}h0' for a, b in points)
        self.items.append(f'<path d="{path}" stroke="{colour}" stroke-width="3.4" stroke-linecap="round" '
                          'stroke-opacity=".55"/>')

    def label(self, row, text, colour):
        y = HEIGHT - BOTTOM - 10 - 13 * row
        self.items.append(f'<text x="{self.x(0) + 8:.1f}" y="{y}" fill="{colour}">{text}</text>')


def steps(end, step):
    return [i * step for i in range(int(end / step + 1e-9) + 1)]


def read(path):
    with open(path, newline='') as file:
        return list(csv.DictReader(file))


def write(path, plots):
    width = WIDTH * len(plots)
    body = '\n'.join(item for plot in plots for item in plot.items)
    with open(path, 'w') as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{HEIGHT}" '
                   f'viewBox="0 0 {width} {HEIGHT}" font-family="sans-serif" font-size="11">\n'
                   f'<rect width="{width}" height="{HEIGHT}" fill="white"/>\n{body}\n</svg>\n')


def draw_curves(folder, out):
    rows = read(f'{folder}/pr_curves.csv')
    methods = list(dict.fromkeys(row['method'] for row in rows))
    plots = []
    for bin_name, title in (('0-45', 'from 0 to 45 degrees'), ('135-180', 'from 135 to 180 degrees')):
        plot = Plot(WIDTH * len(plots), f'Precision over recall, {title}', 'recall', 'precision', 1, 1, .2, .2)
        for i, method in enumerate(methods):
            points = [(float(row['recall']), float(row['precision'])) for row in rows
                      if row['method'] == method and row['viewpoint_deg'] == bin_name]
            plot.curve(([(0, points[0][1])] if points else []) + points, COLOURS[i % len(COLOURS)])
            plot.label(i, method, COLOURS[i % len(COLOURS)])
        plots.append(plot)
    write(f'{out}/pr.svg', plots)


def draw_viewpoints(folder, out, name='viewpoint'):
    rows = read(f'{folder}/{name}_curves.csv')
    methods = list(dict.fromkeys(row['method'] for row in rows))
    plot = Plot(0, 'Keyframes recognised', 'change of viewpoint [degrees]', 'recall', 180, 1, 45, .2)
    for i, method in enumerate(methods):
        colour, points = COLOURS[i % len(COLOURS)], []
        for row in rows:
            if row['method'] == method:
                middle = sum(map(float, row['viewpoint_deg'].split('-'))) / 2
                points.append((middle, float(row['recall'])))
                plot.bar(middle + 1.5 * i, float(row['recall_low']), float(row['recall_high']), colour)
        plot.curve(points, colour)
        plot.dots(points, colour)
        plot.label(i, method, colour)
    write(f'{out}/{name}.svg', [plot])


def draw_viewpoints_of_images(folder, out):
    draw_viewpoints(folder, out, 'viewpoint_images')


def draw_loops(folder, out):
    rows = read(f'{folder}/loops.csv')
    places = list(dict.fromkeys(row['place'] for row in rows))
    distance = Plot(0, f'Position error of {len(rows)} loops', 'change of viewpoint [degrees]', 'metres', 180, 2, 45, .5)
    rotation = Plot(WIDTH, 'Rotation error', 'change of viewpoint [degrees]', 'degrees', 180, 4, 45, 1)
    for i, place in enumerate(places):
        for plot, error in ((distance, 'error_m'), (rotation, 'error_deg')):
            points = [(float(row['viewpoint_deg']), float(row[error])) for row in rows if row['place'] == place]
            plot.dots(points, COLOURS[i % len(COLOURS)])
    write(f'{out}/loops.svg', [distance, rotation])


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, out = sys.argv[1:]
    unfinished = [name for name in os.listdir(folder) if name.startswith('.sslcd-unfinished-')]
    if unfinished:
        sys.exit(f'{folder}: its files may be of two calls ({unfinished[0]}): repeat the sslcd_run bench that was stopped')
    os.makedirs(out, exist_ok=True)
    drawn = 0
    for name, draw in (('pr_curves.csv', draw_curves), ('viewpoint_curves.csv', draw_viewpoints),
                       ('viewpoint_images_curves.csv', draw_viewpoints_of_images), ('loops.csv', draw_loops)):
        if os.path.exists(f'{folder}/{name}'):
            draw(folder, out)
            drawn += 1
    if drawn == 0:
        sys.exit(f'{folder} holds no curves and no loops: run sslcd_run bench pr, viewpoint or attempts first')


if __name__ == '__main__':
    main()
