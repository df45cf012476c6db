#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a run folder from above as an SVG: odometry, trajectory, map and accepted loops.

One loop is shown in detail, by default the one with the largest change of viewpoint: both cameras
with their viewing directions, and the objects that were matched.

usage: draw_run.py RUN OUT.svg [--groundtruth FILE] [--loop QUERY_FRAME]
Needs the Python standard library only. FILE has TUM or KITTI rows, one for each frame.
"""
import argparse
import csv
import json
import math

COLOURS = {'odometry': '#d1495b', 'sslcd': '#1f6feb', 'truth': '#8a8a8a', 'loops': '#2a9d4a'}
FIRST, SECOND, MATCHED = '#2a9d4a', '#8e44ad', '#ff8c1a'
WIDTH, MARGIN_M, VIEW_M, HALF_ANGLE = 900, 6, 22, math.radians(40)


class Plane:
    """The horizontal plane of a world with a given up axis. Positions and directions become (right,
    ahead) of the page, seen from above."""

    def __init__(self, up):
        axis = max(range(3), key=lambda i: abs(up[i]))
        following = [(axis + 1) % 3, (axis + 2) % 3]
        self.axes = following if up[axis] > 0 else following[::-1]

    def of(self, vector):
        return vector[self.axes[0]], vector[self.axes[1]]


def column(q, i):
    """Column i of the rotation matrix of a quaternion x, y, z, w."""
    x, y, z, w = q
    return [(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
            (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
            (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))][i]


def read_poses(path, plane):
    """(position, viewing direction) of each pose in the plane; rows are KITTI's or TUM's."""
    with open(path, encoding='utf-8') as file:
        lines = file.readlines()
    poses = []
    for line in lines:
        row = [float(word) for word in line.split()] if line[0] not in '#\n' else []
        if len(row) == 12:
            poses.append((plane.of(row[3::4]), plane.of(row[2::4])))
        elif len(row) == 8:
            poses.append((plane.of(row[1:4]), plane.of(column(row[4:], 2))))
    return poses


def aligned(points, onto):
    """Moves `points` rigidly to minimise their squared distances to `onto`."""
    count = min(len(points), len(onto))
    a, b = points[:count], onto[:count]
    ca, cb = ([sum(p[i] for p in ps) / count for i in (0, 1)] for ps in (a, b))
    cross = dot = 0
    for p, q in zip(a, b):
        px, py, qx, qy = p[0] - ca[0], p[1] - ca[1], q[0] - cb[0], q[1] - cb[1]
        dot, cross = dot + px * qx + py * qy, cross + px * qy - py * qx
    angle = math.atan2(cross, dot)
    c, s = math.cos(angle), math.sin(angle)
    return [(c * (x - ca[0]) - s * (y - ca[1]) + cb[0], s * (x - ca[0]) + c * (y - ca[1]) + cb[1])
            for x, y in points]


def footprint(item, plane):
    """The four corners of a cuboid from above."""
    pose = item['pose_world_object']
    cx, cy = plane.of(pose[4:])
    hx, hy = plane.of(column(pose[:4], 0))
    norm = math.hypot(hx, hy) or 1
    hx, hy = hx / norm, hy / norm
    length, width, _ = item['dimensions_lwh']
    return [(cx + a * length / 2 * hx - b * width / 2 * hy,
             cy + a * length / 2 * hy + b * width / 2 * hx)
            for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))]


def read_loops(path):
    with open(path, encoding='utf-8') as file:
        return [row for row in csv.DictReader(file) if row['decision'] == 'accepted']


def chosen_loop(loops, query):
    if query is not None:
        found = [loop for loop in loops if int(loop['query_frame']) == query]
        if not found:
            raise SystemExit(f'no accepted loop has the query frame {query}')
        return found[0]
    return max(loops, key=lambda loop: (round(float(loop['viewpoint_change_deg'])),
                                        int(loop['matches'])), default=None)


class Page:
    """An SVG with the plane's points at a scale that fills its width."""

    def __init__(self, points):
        low = [min(p[i] for p in points) - MARGIN_M for i in (0, 1)]
        high = [max(p[i] for p in points) + MARGIN_M for i in (0, 1)]
        self.turned = high[1] - low[1] > high[0] - low[0]  # the longer side lies flat
        extent = [high[0] - low[0], high[1] - low[1]]
        if self.turned:
            extent.reverse()
        self.low, self.high = low, high
        self.scale = WIDTH / extent[0]
        self.height = extent[1] * self.scale + 40
        self.items = []

    def at(self, p):
        if self.turned:  # by a quarter turn, not mirrored
            return (p[1] - self.low[1]) * self.scale, (p[0] - self.low[0]) * self.scale
        return (p[0] - self.low[0]) * self.scale, (self.high[1] - p[1]) * self.scale

    def shape(self, kind, points, style):
        path = ' '.join(f'{x:.1f},{y:.1f}' for x, y in map(self.at, points))
        self.items.append(f'<{kind} points="{path}" {style}/>')

    def text(self, x, y, words, colour):
        self.items.append(f'<text x="{x:.0f}" y="{y:.0f}" fill="{colour}">{words}</text>')

    def scale_bar(self):
        metres = 10 ** math.floor(math.log10(WIDTH / self.scale / 4))
        end, y = WIDTH - 20, self.height - 14
        self.items.append(f'<line x1="{end - metres * self.scale:.1f}" x2="{end}" y1="{y:.0f}" '
                          f'y2="{y:.0f}" stroke="black" stroke-width="2"/>')
        self.text(end - metres * self.scale, y - 5, f'{metres} m', 'black')

    def svg(self):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height:.0f}" '
                'font-family="sans-serif" font-size="15">')
        return '\n'.join([head, f'<rect width="{WIDTH}" height="{self.height:.0f}" fill="white"/>',
                          *self.items, '</svg>']) + '\n'


def draw_camera(page, pose, colour):
    """A camera and its viewing direction."""
    (x, y), (ahead_x, ahead_y) = pose
    heading = math.atan2(ahead_y, ahead_x)
    arc = [(x + VIEW_M * math.cos(heading + HALF_ANGLE * k / 8),
            y + VIEW_M * math.sin(heading + HALF_ANGLE * k / 8)) for k in range(-8, 9)]
    page.shape('polygon', [(x, y), *arc],
               f'fill="{colour}" fill-opacity=".18" stroke="{colour}" stroke-width="1.5"')
    px, py = page.at((x, y))
    page.items.append(f'<circle cx="{px:.1f}" cy="{py:.1f}" r="5" fill="{colour}"/>')


def draw_loop(page, loop, poses):
    query, match = poses[int(loop['query_frame'])], poses[int(loop['match_frame'])]
    draw_camera(page, match, FIRST)
    draw_camera(page, query, SECOND)
    degrees = float(loop['viewpoint_change_deg'])
    page.text(10, page.height - 32, f'{loop["matches"]} objects (orange) match although they are '
              f'seen from directions {degrees:.0f} degrees apart', 'black')


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('run')
    parser.add_argument('out')
    parser.add_argument('--groundtruth')
    parser.add_argument('--loop', type=int, metavar='QUERY_FRAME')
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    with open(f'{arguments.run}/map.json', encoding='utf-8') as file:
        world = json.load(file)
    plane = Plane(world['up_axis'])
    objects = [o for o in world['objects'] if o['state'] == 'confirmed']
    poses = read_poses(f'{arguments.run}/trajectory_tum.txt', plane)
    corrected = [p for p, _ in poses]
    lines = {'odometry': [p for p, _ in read_poses(f'{arguments.run}/odometry_tum.txt', plane)]}
    if arguments.groundtruth:
        truth = [p for p, _ in read_poses(arguments.groundtruth, plane)]
        lines['truth'] = aligned(truth, corrected)
    lines['sslcd'] = corrected
    loops = read_loops(f'{arguments.run}/loops.csv')
    loop = chosen_loop(loops, arguments.loop)
    matched = {int(pair.split(':')[1]) for pair in loop['pairs'].split(';')} if loop else set()

    boxes = {o['id']: footprint(o, plane) for o in objects}
    page = Page([p for line in lines.values() for p in line] +
                [corner for box in boxes.values() for corner in box])
    for name, box in boxes.items():
        fill = MATCHED if name in matched else '#f4dfa6'
        page.shape('polygon', box, f'fill="{fill}" stroke="#7a5c00" stroke-width="0.7"')
    if loop:
        draw_loop(page, loop, poses)
    page.text(10, page.height - 10, f'{len(objects)} objects, {len(loops)} loops', '#7a5c00')
    for k, (name, line) in enumerate(lines.items()):
        dash = ' stroke-dasharray="6 4"' if name == 'truth' else ''
        page.shape('polyline', line,
                   f'fill="none" stroke="{COLOURS[name]}" stroke-width="2"{dash}')
        page.text(210 + 100 * k, page.height - 10, name, COLOURS[name])
    page.scale_bar()
    with open(arguments.out, 'w', encoding='utf-8') as out:
        out.write(page.svg())


if __name__ == '__main__':
    main()
