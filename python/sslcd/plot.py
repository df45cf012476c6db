# SPDX-License-Identifier: BSD-3-Clause
"""Pictures from above by matplotlib: `pip install 'sslcd[plot]'`."""

from typing import Any, Dict, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .inputs import array
from .results import LoopClosure, MapObject, Trajectory

try:
    from matplotlib import pyplot
    from matplotlib.axes import Axes
    from matplotlib.collections import LineCollection, PolyCollection
except ImportError as problem:
    raise ImportError(
        f"sslcd.plot needs matplotlib: pip install 'sslcd[plot]' ({problem})"
    ) from problem

# Okabe and Ito, 2008: colours that differ for all eyes
_COLOURS = ("#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7")
_LOOP_COLOUR = "#d55e00"


def draw(
    trajectory: Trajectory,
    objects: Sequence[MapObject] = (),
    loops: Sequence[LoopClosure] = (),
    *,
    odometry: Optional[Trajectory] = None,
    groundtruth: Optional[Trajectory] = None,
    up: ArrayLike = (0.0, -1.0, 0.0),
    axes: Optional[Axes] = None,
) -> Axes:
    """Draws the path, the confirmed objects and the accepted loops, seen from above. [m]

    Args:
        trajectory, objects, loops: of a Mapper or a RunResult.
        odometry, groundtruth: are drawn as they are; sslcd.ate(...) has the transform that aligns
            them.
        up: [3] the up direction in the world of the trajectory.
        axes: where to draw; None: a new figure.
    """
    axes = axes if axes is not None else pyplot.subplots()[1]
    ground = _core.gravity_axes(array("up", up, (3,)))[:, :2]  # columns forward, left
    _draw_objects(axes, [each for each in objects if each.state == "confirmed"], ground)
    for path, name, style in (
        (groundtruth, "ground truth", {"color": "0.6", "linestyle": "--"}),
        (odometry, "odometry", {"color": "#cc79a7", "linewidth": 1}),
        (trajectory, "sslcd", {"color": "#0072b2"}),
    ):
        if path is not None:
            axes.plot(*(path.positions @ ground).T, label=name, **style)
    _draw_loops(axes, [each for each in loops if each.accepted], trajectory, ground)
    axes.set_aspect("equal", "datalim")
    axes.set_xlabel("[m]")
    axes.set_ylabel("[m]")
    axes.legend()
    return axes


def _draw_objects(axes: Axes, objects: Sequence[MapObject], ground: np.ndarray) -> None:
    by_label: Dict[str, Any] = {}
    for each in objects:
        length, width = each.dims[:2] / 2
        corners = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) * (length, width)
        T = each.T_world_object
        by_label.setdefault(each.label, []).append((corners @ T[:3, :2].T + T[:3, 3]) @ ground)
    for i, (label, outlines) in enumerate(sorted(by_label.items())):
        colour = _COLOURS[i % len(_COLOURS)]
        axes.add_collection(
            PolyCollection(outlines, facecolors=colour, edgecolors="k", linewidths=0.3, label=label)
        )


def _draw_loops(
    axes: Axes, loops: Sequence[LoopClosure], trajectory: Trajectory, ground: np.ndarray
) -> None:
    place = dict(zip(trajectory.frames.tolist(), trajectory.positions @ ground))
    lines = [
        (place[each.match_frame], place[each.query_frame])
        for each in loops
        if each.match_frame in place and each.query_frame in place
    ]
    if lines:
        axes.add_collection(
            LineCollection(lines, colors=_LOOP_COLOUR, linewidths=0.8, label=f"{len(lines)} loops")
        )
