# SPDX-License-Identifier: BSD-3-Clause
"""A sequence folder as numbers, and the rotations to change its poses."""
import math
import os
import re
import struct


# Rotations as 3x3 lists.
def product(A, B):
    return [[sum(a * b for a, b in zip(row, column)) for column in zip(*B)] for row in A]


def transposed(A):
    return [list(column) for column in zip(*A)]


def times(A, v):
    return [sum(a * b for a, b in zip(row, v)) for row in A]


def matrix(q):
    x, y, z, w = q
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]


def quaternion(R):
    w = math.sqrt(max(0, 1 + R[0][0] + R[1][1] + R[2][2])) / 2
    x = math.sqrt(max(0, 1 + R[0][0] - R[1][1] - R[2][2])) / 2
    y = math.sqrt(max(0, 1 - R[0][0] + R[1][1] - R[2][2])) / 2
    z = math.sqrt(max(0, 1 - R[0][0] - R[1][1] + R[2][2])) / 2
    # the largest one decides the signs of the others
    best = max(w, x, y, z)
    if best == w:
        x, y, z = (math.copysign(x, R[2][1] - R[1][2]), math.copysign(y, R[0][2] - R[2][0]), math.copysign(z, R[1][0] - R[0][1]))
    elif best == x:
        y, z, w = (math.copysign(y, R[0][1] + R[1][0]), math.copysign(z, R[0][2] + R[2][0]), math.copysign(w, R[2][1] - R[1][2]))
    elif best == y:
        x, z, w = (math.copysign(x, R[0][1] + R[1][0]), math.copysign(z, R[1][2] + R[2][1]), math.copysign(w, R[0][2] - R[2][0]))
    else:
        x, y, w = (math.copysign(x, R[0][2] + R[2][0]), math.copysign(y, R[1][2] + R[2][1]), math.copysign(w, R[1][0] - R[0][1]))
    return [x, y, z, w]


class Sequence:
    """A sequence folder with detections as KITTI tracking rows: lists of numbers, and the label.

    poses: rows [t, x, y, z, qx, qy, qz, qw]; rows: [frame, id, label, truncated, occluded, alpha, left, top, right,
    bottom, h, w, l, x, y, z, ry, score]."""

    def __init__(self, folder):
        self.files = {}
        for name in sorted(os.listdir(folder)):
            if os.path.isfile(f'{folder}/{name}') and not name.endswith('.npy'):
                with open(f'{folder}/{name}') as file:
                    self.files[name] = file.read()
        self.poses = self.numbers('odometry.txt')
        self.truth = self.numbers('groundtruth.txt')
        self.times = [row[0] for row in self.numbers('times.txt')]
        self.rows = [[int(f[0]), f[1], f[2], *map(float, f[3:])] for f in
                     (line.split() for line in self.files['detections.txt'].splitlines())]
        self.embeddings = None
        if os.path.exists(f'{folder}/embeddings.npy'):
            with open(f'{folder}/embeddings.npy', 'rb') as file:
                data = file.read()
            size = 10 + struct.unpack('<H', data[8:10])[0]
            self.header, shape = data[:size], re.search(rb"'shape': \((\d+), (\d+)\)", data[:size])
            width = int(shape[2]) * 4
            self.embeddings = [data[i:i + width] for i in range(size, len(data), width)]

    def numbers(self, name):
        return [[float(x) for x in line.split()] for line in self.files.get(name, '').splitlines() if line and line[0] != '#']

    def write(self, folder):
        os.makedirs(folder)
        texts = dict(self.files)
        texts['odometry.txt'] = ''.join(' '.join('%.9g' % x if i else '%.6f' % x for i, x in enumerate(row)) + '\n' for row in self.poses)
        texts['times.txt'] = ''.join('%.6f\n' % t for t in self.times)
        if self.truth:
            texts['groundtruth.txt'] = ''.join(' '.join('%.9g' % x if i else '%.6f' % x for i, x in enumerate(row)) + '\n' for row in self.truth)
        texts['detections.txt'] = ''.join(' '.join(x if isinstance(x, str) else '%.6g' % x for x in row) + '\n' for row in self.rows)
        for name, text in texts.items():
            with open(f'{folder}/{name}', 'w') as file:
                file.write(text)
        if self.embeddings is not None:
            with open(f'{folder}/embeddings.npy', 'wb') as file:
                file.write(self.header + b''.join(self.embeddings))
