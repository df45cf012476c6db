#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes one large map with regular rows and local maps for `sslcd_run match` (docs/formats.md): QUERIES of places in the
map, and as many of places that are not in it ("absent"). The map is a grid of the streets or lots of make_object_pairs.py,
oriented alike. usage: make_city.py OBJECTS street|lot QUERIES SEED OUT.txt        needs numpy."""
import math
import sys

import numpy as np

from make_object_pairs import (CELLS, LOT, STREET, add_clutter, lot, mapped, random_centre, random_pose, seen, shuffled,
                               street, write_pair, write_rows)

SPACING = {STREET: (140.0, 60.0), LOT: (105.0, 75.0)}  # of the blocks [m]
BLOCK = {STREET: street, LOT: lot}


def make_blocks(rng, scene, count):
    blocks = []
    while count > 0:
        blocks.append(BLOCK[scene](rng))
        count -= len(blocks[-1])
    return blocks


def place(blocks, scene):
    """Moves each block to its place in the grid, whose outline is nearly a square."""
    dx, dy = SPACING[scene]
    columns = max(1, math.ceil(math.sqrt(len(blocks) * dy / dx)))
    return [[(x + dx * (k % columns), y + dy * (k // columns), z, name) for x, y, z, name in cars]
            for k, cars in enumerate(blocks)]


def make_query(rng, scene, noise, detected, choose_block):
    """A local map, and its pose in the block."""
    while True:
        block, centre, pose = choose_block(), random_centre(rng, scene), random_pose(rng)
        here = seen(rng, scene, block["cars"], noise, detected, centre, pose)
        if len(here) >= 5:
            here = add_clutter(rng, here, scene, detected, centre, pose)
            return shuffled(rng, here), (pose[0], pose[1] + block["offset"])


def main():
    count, scene, queries, seed = int(sys.argv[1]), sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    rng = np.random.default_rng(seed)
    blocks = make_blocks(rng, scene, count)
    placed = place(blocks, scene)

    def of_map():
        k = rng.integers(len(blocks))
        return {"cars": blocks[k], "offset": np.array(placed[k][0][:3]) - np.array(blocks[k][0][:3])}

    def elsewhere():
        return {"cars": BLOCK[scene](rng), "offset": np.zeros(3)}

    objects = mapped(rng, [car for cars in placed for car in cars])
    with open(sys.argv[5], "w") as out:
        out.write("MAP %d\n" % len(objects))
        write_rows(out, "G", objects)
        for number in range(2 * queries):
            noise, detected = CELLS[number % len(CELLS)]
            absent = number >= queries
            here, pose = make_query(rng, scene, noise, detected, elsewhere if absent else of_map)
            name = "%s%s/n%g/p%g" % (scene, "-absent" if absent else "", noise, detected)
            write_pair(out, number, name, here, [], pose)


if __name__ == "__main__":
    if len(sys.argv) != 6 or sys.argv[2] not in BLOCK:
        sys.exit(__doc__)
    main()
