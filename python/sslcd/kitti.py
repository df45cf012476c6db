# SPDX-License-Identifier: BSD-3-Clause
"""Cuboids as KITTI writes them."""

from typing import Tuple

import numpy as np
from numpy.typing import ArrayLike

from .inputs import per_detection


def kitti_cuboids(
    locations: ArrayLike, rotations_y: ArrayLike, dims_hwl: ArrayLike
) -> Tuple[np.ndarray, np.ndarray]:
    """Poses [N, 4, 4] and dims [N, 3] for Mapper.add_frame from columns of KITTI's labels.

    Args:
        locations: [N, 3] centres of the bottom faces in the camera [m].
        rotations_y: [N] about the camera's y axis; 0: the length points along x [rad].
        dims_hwl: [N, 3] height, width, length [m].
    """
    bottom = per_detection("locations", locations, len(np.atleast_1d(locations)), (3,))
    turn = per_detection("rotations_y", rotations_y, len(bottom), ())
    height, width, length = per_detection("dims_hwl", dims_hwl, len(bottom), (3,)).T
    cos, sin, zero, one = np.cos(turn), np.sin(turn), np.zeros(len(bottom)), np.ones(len(bottom))
    poses = np.zeros((len(bottom), 4, 4))
    poses[:, :3, 0] = np.stack([cos, zero, -sin], 1)  # along the length
    poses[:, :3, 1] = np.stack([sin, zero, cos], 1)  # to the left
    poses[:, :3, 2] = (0, -1, 0)  # up
    poses[:, :3, 3] = bottom - np.stack([zero, height / 2, zero], 1)
    poses[:, 3, 3] = one
    return poses, np.stack([length, width, height], 1)
