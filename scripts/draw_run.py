#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a run folder from above as an SVG: odometry, corrected trajectory, objects of the map and, if given, the truth.

usage: draw_run.py RUN OUT.svg [--groundtruth TUM_OR_KITTI_ROWS]      needs the Python standard library only
"""
import argparse
import json
import math

COLOURS = {'odometry': '#d1495b', 'corrected': '#1f6feb', 'truth': '#8a8a8a'}


def positions(path):
    """(x, z) of each pose: KITTI's 12 columns or TUM's 8."""
    rows = [[float(v) for v in line.split()] for line in open(path) if line.strip()]
    return [(r[3], r[11]) if len(r) == 12 else (r[1], r[3]) for r in rows]


def corners(obj):
    """The four corners of a cuboid's footprint."""
    qx, qy, qz, qw, tx, _, tz = obj['pose_world_object']
    length, width, _ = obj['dimensions_lwh']
    hx, hz = 1 - 2 * (qy * qy + qz * qz), 2 * (qx * qz - qy * qw)  # the x axis, seen from above
    norm = math.hypot(hx, hz) or 1
    hx, hz = hx / norm, hz / norm
    return [(tx + a * length / 2 * hx - b * width / 2 * hz, tz + a * length / 2 * hz + b * width / 2 * hx)
            for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('run')
    parser.add_argument('out')
    parser.add_argument('--groundtruth')
    args = parser.parse_args()

    lines = {'odometry': positions(f'{args.run}/odometry_kitti.txt')}
    if args.groundtruth:
        lines['truth'] = positions(args.groundtruth)
    lines['corrected'] = positions(f'{args.run}/trajectory_kitti.txt')
    boxes = [corners(o) for o in json.load(open(f'{args.run}/map.json'))['objects'] if o['state'] == 'confirmed']

    points = [p for line in lines.values() for p in line] + [c for box in boxes for c in box]
    low = [min(p[i] for p in points) - 5 for i in (0, 1)]
    high = [max(p[i] for p in points) + 5 for i in (0, 1)]
    turn = high[1] - low[1] > high[0] - low[0]  # the longer side lies flat
    extent = (high[1] - low[1], high[0] - low[0]) if turn else (high[0] - low[0], high[1] - low[1])
    scale = 900 / extent[0]

    def pixel(p):
        x, y = (p[1] - low[1], p[0] - low[0]) if turn else (p[0] - low[0], high[1] - p[1])
        return f'{x * scale:.1f},{y * scale:.1f}'

    height = extent[1] * scale + 30
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 900 {height:.0f}" font-family="sans-serif" font-size="14">',
           f'<rect width="900" height="{height:.0f}" fill="white"/>']
    svg += [f'<polygon points="{" ".join(map(pixel, box))}" fill="#f2c14e" stroke="#7a5c00" stroke-width="0.6"/>' for box in boxes]
    for k, (name, line) in enumerate(lines.items()):
        dash = ' stroke-dasharray="6 4"' if name == 'truth' else ''
        svg.append(f'<polyline points="{" ".join(map(pixel, line))}" fill="none" stroke="{COLOURS[name]}" stroke-width="2"{dash}/>')
        svg.append(f'<text x="{10 + 120 * k}" y="{height - 10:.0f}" fill="{COLOURS[name]}">{name}</text>')
    svg.append(f'<text x="{10 + 120 * len(lines)}" y="{height - 10:.0f}" fill="#7a5c00">{len(boxes)} objects</text></svg>')
    with open(args.out, 'w') as out:
        out.write('\n'.join(svg) + '\n')


if __name__ == '__main__':
    main()
