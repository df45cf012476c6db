#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes pairs of local and global maps with known pose, for `sslcd_run match` (docs/formats.md): streets with cars along
both kerbs, and regular lots. usage: make_object_pairs.py SEED OUT.txt [PAIRS_PER_CELL]        needs numpy.

A cell is a scene, a noise of the local positions (0.1, 0.3, 0.5 m) and a share of objects detected (0.9, 0.6). The global
map misses 5 % and is off by 0.1 m; 2 % of the labels are wrong; clutter joins the local map."""
import sys

import numpy as np

STREET, LOT = "street", "lot"
CELLS = [(noise, detected) for noise in (0.1, 0.3, 0.5) for detected in (0.9, 0.6)]
HALF_SIDE = {STREET: 21.0, LOT: 12.3}  # of the square that the local map covers [m]


def label(rng):
    return rng.choice(3, p=[0.8, 0.12, 0.08])


def seen_label(rng, true_label):
    return true_label if rng.random() > 0.02 else rng.integers(3)


def street(rng):
    bend = rng.uniform(-0.001, 0.001)
    cars = []
    for side in (-1, 1):
        x, kerb = -60 + rng.uniform(0, 8), side * rng.normal(5, 0.1)
        while x < 70:
            cars.append((x, kerb + bend * x * x + rng.normal(0, 0.25), rng.normal(0, 0.1), label(rng)))
            x += 5 + rng.exponential(3.1)
    return cars


def lot(rng):
    stalls = [(2.5 * column - 40, 8.0 * row - 24) for row in range(7) for column in range(33)]
    return [(x + rng.normal(0, 0.15), y + rng.normal(0, 0.25), rng.normal(0, 0.1), label(rng))
            for x, y in stalls if rng.random() < 0.6]


def clutter(rng, scene, detected, centre):
    mean = 1.3 if detected > 0.7 else 1.7 if scene == STREET else 3.3
    for _ in range(rng.poisson(mean)):
        x, y = centre + rng.uniform(-HALF_SIDE[scene], HALF_SIDE[scene], 2)
        yield x, rng.uniform(-10, 10) if scene == STREET else y, rng.normal(0, 0.1), rng.integers(3)


def random_pose(rng):
    """Yaw and shift from a local map to the global one."""
    return rng.uniform(-np.pi, np.pi), np.array([*rng.uniform(-40, 40, 2), rng.normal(0, 0.28)])


def to_local(point, pose):
    c, s = np.cos(pose[0]), np.sin(pose[0])
    return np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) @ (np.asarray(point) - pose[1])


def mapped(rng, cars):
    """Rows of the global map: identity, label, x, y, z."""
    return [(k, seen_label(rng, car[3]), *(np.array(car[:3]) + rng.normal(0, [0.1, 0.1, 0.05])))
            for k, car in enumerate(cars) if rng.random() < 0.95]


def random_centre(rng, scene):
    return np.array([rng.uniform(-35, 35), 0] if scene == STREET else [rng.uniform(-22, 22), rng.uniform(-16, 16)])


def seen(rng, scene, cars, noise, detected, centre, pose):
    """Rows of the local map."""
    return [(k, seen_label(rng, car[3]), *to_local(car[:3] + rng.normal(0, [noise, noise, noise / 2]), pose))
            for k, car in enumerate(cars)
            if max(abs(car[0] - centre[0]), abs(car[1] - centre[1])) < HALF_SIDE[scene] and rng.random() < detected]


def add_clutter(rng, here, scene, detected, centre, pose):
    return here + [(-1, car[3], *to_local(car[:3], pose)) for car in clutter(rng, scene, detected, centre)]


def shuffled(rng, rows):
    return [rows[k] for k in rng.permutation(len(rows))]


def make_pair(rng, scene, noise, detected):
    """Rows of the local and of the global map, and the pose of the local one."""
    while True:
        cars = street(rng) if scene == STREET else lot(rng)
        there, centre, pose = mapped(rng, cars), random_centre(rng, scene), random_pose(rng)
        here = seen(rng, scene, cars, noise, detected, centre, pose)
        common = {row[0] for row in there} & {row[0] for row in here}
        local = add_clutter(rng, here, scene, detected, centre, pose)
        if len(here) >= 5 and len(common) >= 4:
            return shuffled(rng, local), there, pose


def write_rows(out, letter, rows):
    for row in rows:
        out.write("%s %d %d %.4f %.4f %.4f\n" % (letter, *row))


def write_pair(out, number, scene, here, there, pose):
    out.write("PAIR %d %s %d %d %.9f %.6f %.6f %.6f\n" % (number, scene, len(here), len(there), pose[0], *pose[1]))
    write_rows(out, "L", here)
    write_rows(out, "G", there)


def main():
    rng = np.random.default_rng(int(sys.argv[1]))
    per_cell = int(sys.argv[3]) if len(sys.argv) > 3 else 30
    with open(sys.argv[2], "w") as out:
        out.write("# PAIR id scene nl ng yaw tx ty tz, then the rows of the local (L) and of the global map (G):"
                  " identity label x y z\n")
        cells = [(scene, *cell) for scene in (STREET, LOT) for cell in CELLS for _ in range(per_cell)]
        for number, (scene, noise, detected) in enumerate(cells):
            write_pair(out, number, "%s/n%g/p%g" % (scene, noise, detected), *make_pair(rng, scene, noise, detected))


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main()
