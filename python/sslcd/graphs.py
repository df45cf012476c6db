# SPDX-License-Identifier: BSD-3-Clause
"""Pose graphs."""

import os
import warnings
from dataclasses import replace
from typing import Optional, Union

from numpy.typing import ArrayLike

from . import _core
from .inputs import array, checked
from .results import GraphSolution, PoseGraph


def read_g2o(path: Union[str, "os.PathLike[str]"]) -> PoseGraph:
    """Reads `VERTEX_SE3:QUAT`, `EDGE_SE3:QUAT`, `VERTEX_SE2`, `EDGE_SE2` and `FIX` rows. Edges
    between ids that are not consecutive are loops. Warns about rows of other kinds, and about
    information that is not positive definite, which is projected to the nearest matrix that is.
    Raises BadInputError with file and line."""
    graph, planar, rows_ignored, projected = _core.read_g2o(os.fspath(path))
    if rows_ignored:
        warnings.warn(f"{path}: {rows_ignored} rows of other kinds were left out", stacklevel=2)
    if projected:
        warnings.warn(
            f"{path}: {projected} information matrices are not positive definite and were "
            "projected to the nearest ones that are",
            stacklevel=2,
        )
    return replace(graph, planar=planar)


def solve_graph(
    graph: PoseGraph,
    *,
    dof: Optional[int] = None,
    up: ArrayLike = (0.0, 0.0, 1.0),
    start: str = "auto",
    robust: bool = False,
) -> GraphSolution:
    """Moves the vertices to the minimum of chi2.

    Args:
        graph: is not changed.
        dof: of a pose: 6, 4 (translation and yaw about `up`) or 3 (4 with fixed height); None: 3 if
            the graph is planar, else 6.
        up: [3] the world's vertical.
        start: "given", "chordal", or "auto": the better one.
        robust: refuse loops that contradict the others.

    Raises:
        NoSolutionError: the graph is malformed.
    """
    checked("graph", graph, PoseGraph)
    freedom = dof if dof is not None else 3 if graph.planar else 6
    solution = _core.solve_graph(graph, freedom, array("up", up, (3,)), start, robust)
    return replace(solution, graph=replace(solution.graph, planar=graph.planar))
