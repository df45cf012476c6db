#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the 2D boxes of a rendered sequence from its instance images: those of a perfect detector,
or with --sigma-px with noise on the sides. For `sslcd_sim halv --render --render-truth` folders (docs/halv_sim.md, docs/formats.md).

instance_boxes.py SEQUENCE OUT.txt [--labels Car,Van,Truck] [--min-height 20] [--min-pixels 400] [--sigma-px 0] [--seed 1]
                  [--every 1]
"""
import argparse
import collections
import pathlib
import sys

import cv2
import numpy as np


def labels_of(sequence):
    """The most frequent label of each identity, since a few detections have a wrong one."""
    votes = collections.defaultdict(collections.Counter)
    rows = (sequence / "detections.txt").read_text().splitlines()
    for row, identity in zip(rows, (sequence / "landmark_ids.txt").read_text().split()):
        votes[int(identity)][row.split()[2]] += 1
    return {identity: counter.most_common(1)[0][0] for identity, counter in votes.items() if identity >= 0}


def boxes_of(instances, min_height, min_pixels):
    """(identity, left, top, right, bottom) of the visible part of each object: the outer edges of
    its pixels, whose centres lie at whole numbers."""
    where = np.flatnonzero(instances)
    values = instances.ravel()[where]
    order = np.argsort(values, kind="stable")
    starts = np.flatnonzero(np.diff(values[order], prepend=0))
    for pixels in np.split(where[order], starts[1:]):
        if len(pixels) == 0:
            continue
        value = instances.ravel()[pixels[0]]
        rows, columns = np.divmod(pixels, instances.shape[1])
        # Leaves out the outermost half per cent on each side, e.g. a wing mirror beyond a pole.
        left, right = np.percentile(columns, [0.25, 99.75])
        top, bottom = np.percentile(rows, [0.25, 99.75])
        if bottom - top + 1 >= min_height and len(rows) >= min_pixels:
            yield int(value) - 1, left - 0.5, top - 0.5, right + 0.5, bottom + 0.5


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sequence", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--labels", default="Car,Van,Truck")
    parser.add_argument("--min-height", type=float, default=20)
    parser.add_argument("--min-pixels", type=int, default=400)
    parser.add_argument("--sigma-px", type=float, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--every", type=int, default=1, help="every so many frames")
    args = parser.parse_args()
    labels = labels_of(args.sequence)
    wanted = set(args.labels.split(","))
    random = np.random.default_rng(args.seed)
    images = sorted((args.sequence / "instance_2").glob("*.png"))[:: args.every]
    if not images:
        sys.exit(f"{args.sequence}: no instance_2/*.png; render it with --render-truth")
    with args.out.open("w") as out:
        for path in images:
            instances = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
            height, width = instances.shape
            for identity, *sides in boxes_of(instances, args.min_height, args.min_pixels):
                if labels.get(identity) not in wanted:
                    continue
                left, top, right, bottom = sides + random.normal(0, args.sigma_px, 4)
                left, top, right, bottom = max(left, 0), max(top, 0), min(right, width), min(bottom, height)
                if right > left and bottom > top:
                    print(int(path.stem), labels[identity], 1, f"{left:.1f} {top:.1f} {right:.1f} {bottom:.1f}", file=out)


if __name__ == "__main__":
    main()
