# SPDX-License-Identifier: BSD-3-Clause
"""Errors of trajectories, the same as evo's."""

from typing import Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .errors import UsageError
from .inputs import array
from .results import AteResult, RpeResult, Trajectory

Poses = Union[Trajectory, ArrayLike]


def ate(
    estimate: Poses,
    reference: Poses,
    alignment: str = "se3",
    *,
    up: ArrayLike = (0.0, -1.0, 0.0),
    max_difference: float = 0.01,
) -> AteResult:
    """Absolute trajectory error: distances of positions after alignment.

    Args:
        estimate, reference: two Trajectory, matched by their stamps, or two arrays [N, 4, 4] [m].
        alignment: "none", "4dof" (translation and yaw about `up`), "se3" or "sim3" (and one scale).
        up: [3] the vertical of both worlds, for "4dof".
        max_difference: of matched stamps [s].

    Raises:
        NoSolutionError: no stamps match.
    """
    est, ref = _matched(estimate, reference, max_difference)
    return _core.ate(est, ref, alignment, array("up", up, (3,)))


def rpe(
    estimate: Poses,
    reference: Poses,
    delta: float = 1,
    unit: str = "frames",
    *,
    all_pairs: bool = False,
    max_difference: float = 0.01,
) -> RpeResult:
    """Relative pose error.

    Args:
        estimate, reference, max_difference: as of ate().
        delta: length of a step, in `unit`.
        unit: "frames", or "metres" of the estimated path.
        all_pairs: overlapping steps from every pose.
    """
    est, ref = _matched(estimate, reference, max_difference)
    return _core.rpe(est, ref, delta, unit, all_pairs)


def _matched(
    estimate: Poses, reference: Poses, max_difference: float
) -> Tuple[np.ndarray, np.ndarray]:
    if isinstance(estimate, Trajectory) and isinstance(reference, Trajectory):
        return _core.match_by_stamp(estimate, reference, max_difference)
    if isinstance(estimate, Trajectory) or isinstance(reference, Trajectory):
        raise UsageError(
            "estimate and reference are a Trajectory and an array: give two of one kind"
        )
    return array("estimate", estimate, (None, 4, 4)), array("reference", reference, (None, 4, 4))
