#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes tests/data/object_pairs.txt, loops.g2o and loops_truth.g2o: made-up layouts and a drive.

    scripts/make_test_data.py [tests/data]

All data is synthetic; tests/data/README.md describes the files. The same Python gives the same bytes.
"""
import math
import random
import sys
from pathlib import Path

FOLDER = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent / "tests/data")
CAR, POLE, TREE = 0, 1, 2


def turned(yaw, x, y):
    return math.cos(yaw) * x - math.sin(yaw) * y, math.sin(yaw) * x + math.cos(yaw) * y


def lot(rng):
    """Four rows of parking spaces along two aisles, two of three taken, and poles."""
    objects = [(CAR, 2.6 * i + rng.gauss(0, 0.15), row + rng.gauss(0, 0.2), rng.gauss(0.75, 0.05))
               for row in (0, 12, 18, 30) for i in range(20) if rng.random() < 0.65]
    return objects + [(POLE, rng.uniform(0, 52), rng.choice((3, 15, 27)), 1.5) for _ in range(6)]


def street(rng):
    """Cars, poles and trees along both sides of 160 m."""
    objects = []
    for side in (-1, 1):
        x = rng.uniform(0, 8)
        while x < 160:
            label = rng.choice((CAR, CAR, POLE, TREE))
            y = side * (4 if label == CAR else 6) + rng.gauss(0, 0.4)
            objects.append((label, x, y, rng.gauss(1, 0.1)))
            x += rng.uniform(6, 14)
    return objects


def seen_from(objects, pose, rng):
    """The objects that one pass detects, in a frame at pose = (yaw, x, y, z) in the world: 90 % of the
    objects with errors of 0.25 m, and 10 % false ones. Rows (identity, label, x, y, z)."""
    yaw, tx, ty, tz = pose
    centre = rng.choice(objects)
    rows = []
    for identity, (label, x, y, z) in enumerate(objects):
        if math.hypot(x - centre[1], y - centre[2]) > 22 or rng.random() < 0.1:
            continue
        rows.append((identity, label, x, y, z))
        if rng.random() < 0.1:
            rows.append((-1, label, x + rng.uniform(-9, 9), y + rng.uniform(-9, 9), z))
    result = []
    for identity, label, x, y, z in rows:
        x, y = turned(-yaw, x - tx, y - ty)
        result.append((identity, label, x + rng.gauss(0, 0.25), y + rng.gauss(0, 0.25),
                       z - tz + rng.gauss(0, 0.05)))
    rng.shuffle(result)
    return result


def write_pairs(path):
    lines = ["# PAIR id scene nl ng yaw tx ty tz; then nl rows 'L identity label x y z', ng rows 'G ...'"]
    for pair in range(40):
        rng = random.Random(1000 + pair)
        make = (lot, street)[pair % 2]
        world, absent = make(rng), pair >= 32  # the last ones were seen in another world
        pose = (rng.uniform(-math.pi, math.pi), rng.uniform(-30, 30), rng.uniform(-30, 30),
                rng.uniform(-0.2, 0.2))
        local = seen_from(make(rng) if absent else world, pose, rng)
        scene = f"{'absent' if absent else 'present'}/{make.__name__}"
        lines.append(f"PAIR {pair} {scene} {len(local)} {len(world)} " +
                     " ".join(f"{v:.6f}" for v in pose))
        lines += [f"L {i} {label} {x:.3f} {y:.3f} {z:.3f}" for i, label, x, y, z in local]
        lines += [f"G {i} {label} {x:.3f} {y:.3f} {z:.3f}" for i, (label, x, y, z) in enumerate(world)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def times(a, b):
    """Planar poses (x, y, yaw)."""
    x, y = turned(a[2], b[0], b[1])
    return a[0] + x, a[1] + y, math.remainder(a[2] + b[2], 2 * math.pi)


def between(a, b):
    x, y = turned(-a[2], b[0] - a[0], b[1] - a[1])
    return x, y, math.remainder(b[2] - a[2], 2 * math.pi)


def row(pose):
    half = pose[2] / 2
    return f"{pose[0]:.4f} {pose[1]:.4f} 0 0 0 {math.sin(half):.7f} {math.cos(half):.7f}"


def write_graph(path, truth_path):
    rng = random.Random(7)
    lap, laps = 100, 3
    truth = [(0.0, 0.0, 0.0)]
    while len(truth) < lap * laps:  # a rounded square, 1 m a step
        truth.append(times(truth[-1], (1, 0, math.pi / 10 if len(truth) % 25 >= 20 else 0)))

    def edge(a, b, measured, sigma_m, sigma_rad):
        noisy = (measured[0] + rng.gauss(0, sigma_m), measured[1] + rng.gauss(0, sigma_m),
                 measured[2] + rng.gauss(0, sigma_rad))
        diagonal = 3 * [sigma_m ** -2] + 3 * [sigma_rad ** -2]
        upper = " ".join(f"{diagonal[i]:.6g}" if i == j else "0"
                         for i in range(6) for j in range(i, 6))
        return noisy, f"EDGE_SE3:QUAT {a} {b} {row(noisy)} {upper}"

    odometry, rows = [truth[0]], []
    for i in range(len(truth) - 1):
        step, line = edge(i, i + 1, between(truth[i], truth[i + 1]), 0.05, 0.006)
        odometry.append(times(odometry[-1], step))
        rows.append(line)
    for k in range(48):  # every third loop is false
        to = rng.randrange(lap, len(truth))
        match = to % lap + lap * rng.randrange(to // lap)
        measured = between(truth[match], truth[to])
        if k % 6 == 2:  # the next parking space taken for this one
            measured = times((0, rng.choice((-2.6, 2.6)), 0), measured)
        if k % 6 == 5:  # any place taken for any other
            match = rng.randrange(to - lap // 2)
            measured = (rng.uniform(-4, 4), rng.uniform(-4, 4), rng.uniform(-math.pi, math.pi))
        rows.append(edge(match, to, measured, 0.1, 0.01)[1])
    for name, poses, edges in ((path, odometry, rows), (truth_path, truth, [])):
        vertices = [f"VERTEX_SE3:QUAT {i} {row(pose)}" for i, pose in enumerate(poses)]
        name.write_text("\n".join(vertices + edges) + "\n", encoding="utf-8")


write_pairs(FOLDER / "object_pairs.txt")
write_graph(FOLDER / "loops.g2o", FOLDER / "loops_truth.g2o")
