# SPDX-License-Identifier: BSD-3-Clause
"""Object-level mapping and loop closure for visual SLAM.

Transforms are 4x4 matrices named by frames: T_world_cam maps points of the camera to the world.
Lengths are in metres, angles in radians, times in seconds. docs/python.md has the guide,
docs/conventions.md the conventions.
"""

from . import _core
from .async_mapper import AsyncMapper
from .colours import colour_vectors
from .datasets import Dataset, RunResult, load_dataset, run
from .errors import BadConfigError, BadInputError, Error, NoSolutionError, OutputError, UsageError
from .evaluation import ate, rpe
from .graphs import read_g2o, solve_graph
from .inputs import Camera, Frame
from .kitti import kitti_cuboids
from .layouts import Layout, PlaceAnswer, PlaceQuery, match, read_layout_pairs
from .map_results import (
    ChangeRates,
    Localisation,
    MapDiff,
    MapInfo,
    MapResults,
    MergedSession,
    MergeReport,
    PlaceChange,
    PlaceHistory,
    PlaceOutcome,
    SessionInfo,
)
from .mapper import Mapper
from .map_history import MapHistory
from .maps import Localiser, Map, MapSession
from .options import complete_options, default_options, read_options
from .results import (
    AdjustmentSummary,
    AsyncReport,
    AteResult,
    ErrorStats,
    FilterReport,
    FrameReport,
    GraphSolution,
    Hypothesis,
    Improvement,
    LoopClosure,
    LoopSearchSummary,
    MapChanges,
    MapObject,
    MapPart,
    MapUpdate,
    MatchResult,
    NoiseScale,
    PoseGraph,
    RpeResult,
    SiteCandidate,
    StageTimes,
    Trajectory,
)
from .sites import SiteIndex

__version__: str = _core.__version__
__all__ = [
    "AdjustmentSummary",
    "AsyncMapper",
    "AsyncReport",
    "AteResult",
    "BadConfigError",
    "BadInputError",
    "Camera",
    "ChangeRates",
    "Dataset",
    "Error",
    "ErrorStats",
    "FilterReport",
    "Frame",
    "FrameReport",
    "GraphSolution",
    "Hypothesis",
    "Improvement",
    "Layout",
    "Localisation",
    "Localiser",
    "LoopClosure",
    "LoopSearchSummary",
    "Map",
    "MapChanges",
    "MapDiff",
    "MapHistory",
    "MapInfo",
    "MapObject",
    "MapPart",
    "MapResults",
    "MapSession",
    "MapUpdate",
    "Mapper",
    "MatchResult",
    "MergeReport",
    "MergedSession",
    "NoSolutionError",
    "NoiseScale",
    "OutputError",
    "PlaceAnswer",
    "PlaceChange",
    "PlaceHistory",
    "PlaceOutcome",
    "PlaceQuery",
    "PoseGraph",
    "RpeResult",
    "RunResult",
    "SessionInfo",
    "SiteCandidate",
    "SiteIndex",
    "StageTimes",
    "Trajectory",
    "UsageError",
    "ate",
    "colour_vectors",
    "complete_options",
    "default_options",
    "kitti_cuboids",
    "load_dataset",
    "match",
    "read_g2o",
    "read_layout_pairs",
    "read_options",
    "rpe",
    "run",
    "solve_graph",
]
