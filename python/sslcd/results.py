# SPDX-License-Identifier: BSD-3-Clause
"""What comes out of a mapper. Values are copies: they do not change when the mapper goes on."""

from dataclasses import dataclass
from typing import Dict, List, Optional

import numpy as np

from . import _core
from .compact import _Compact
from .errors import UsageError
from .inputs import array


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory(_Compact):
    """N stamped poses in order of time."""

    frames: np.ndarray  #: [N] frame numbers
    stamps: np.ndarray  #: [N] [s]
    poses: np.ndarray  #: [N, 4, 4] T_world_cam [m]

    def __len__(self) -> int:
        return len(self.stamps)

    @property
    def positions(self) -> np.ndarray:
        """[N, 3] positions of the camera in the world [m]."""
        return self.poses[:, :3, 3]

    def tum(self) -> str:
        """The text of a TUM file (`t x y z qx qy qz qw`), as evo reads it."""
        return _core.tum_text(self.stamps, self.poses)

    def kitti(self) -> str:
        """The text of a KITTI file (a 3x4 matrix per row)."""
        return _core.kitti_text(self.poses)


@dataclass(frozen=True, eq=False, repr=False)
class LoopClosure(_Compact):
    """One attempt to close a loop, accepted or refused."""

    id: int  #: of the attempt; stays when the decision changes
    newest_frame: int  #: newest frame of the attempt; the query frame may be earlier
    query_frame: int  #: the new camera
    match_frame: int  #: the old camera
    decision: str  #: "accepted", "ambiguous" or "none"
    reason: str  #: why it was accepted or refused
    score: float  #: log odds that the pose is right [nats]
    second_score: float  #: the same for the second best pose
    probability: Optional[float]  #: that the pose is right, by what was known at the attempt
    T_match_query: np.ndarray  #: [4, 4] the query camera in the match camera's frame [m]
    #: [6, 6] of the right perturbation T_match_query Exp(d), d = [translation, rotation] [m, rad]
    covariance: np.ndarray
    by_views: bool  #: measured by aligned images instead of objects
    early: bool  #: of a camera near the newest one; withdrawn when its own attempt is made
    viewpoint_change: float  #: angle between the two headings, in [0, pi] [rad]
    pairs: np.ndarray  #: [M, 2] matched landmark ids: of the local and of the global map

    @property
    def accepted(self) -> bool:
        return self.decision == "accepted"


@dataclass(frozen=True, eq=False, repr=False)
class MapObject(_Compact):
    """A landmark. The map is made of those that are confirmed."""

    id: int
    label: str
    state: str  #: "tentative", "confirmed", "dynamic" (moves) or "stale" (given up)
    #: [4, 4] upright, at the cuboid's centre: x along its length, y to its left, z up [m]
    T_world_object: np.ndarray
    dims: np.ndarray  #: [3] length, width, height [m]
    observations: np.ndarray  #: [M, 2] frame number, and row of the detection (Frame.rows)


@dataclass(frozen=True)
class MapPart:
    """Frames between which odometry was never lost, up to the first one of the next part. Until
    loops join it with other parts, its poses hold among themselves only."""

    first_frame: int
    sequence: int  #: number of its sequence, from 0 on
    #: the earliest part that accepted loops join it with, by number; its own number: none
    joined_with: int


@dataclass(frozen=True, eq=False, repr=False)
class MapChanges(_Compact):
    """What has changed since it was last asked for, for those who keep a copy of the results."""

    T_world_odom: np.ndarray  #: [4, 4] correction of the newest odometry (ROS: map to odom) [m]
    scale: float  #: metres per odometry metre
    poses: Trajectory  #: the first frame whose pose has changed, and all frames after it
    #: attempts that are new or changed, by id; one that is taken back is among them with its new
    #: decision

    loops: List[LoopClosure]
    parts: List[MapPart]  #: all, if one is new or joined with others than before; otherwise empty


@dataclass(frozen=True)
class FilterReport:
    """Counts of filtered detections, each for the first reason that applies."""

    kept: int
    invalid: int  #: not finite, or a score that is no probability
    low_score: int
    too_far: int
    wrong_size: int
    too_many: int  #: beyond the best ones of its frame

    @property
    def dropped(self) -> int:
        return self.invalid + self.low_score + self.too_far + self.wrong_size + self.too_many


@dataclass(frozen=True, eq=False, repr=False)
class MapUpdate(_Compact):
    """The changes of the map by one frame."""

    matched: np.ndarray  #: [N] landmark id of each detection as given; -1: none, or filtered
    born: int  #: numbers of landmarks that are new, and that became confirmed or driving
    confirmed: int
    turned_dynamic: int


@dataclass(frozen=True)
class AdjustmentSummary:
    """What an optimisation did."""

    usable: bool  #: False: nothing was optimised
    converged: bool
    iterations: int
    initial_cost: float  #: half the sum of squared, robust residuals
    final_cost: float
    message: str


@dataclass(frozen=True, eq=False, repr=False)
class FrameReport(_Compact):
    """The result of one frame."""

    T_world_cam: np.ndarray  #: [4, 4] current estimate [m]
    keyframe: bool
    changes: MapChanges  #: since the report before
    filter: FilterReport
    map: MapUpdate
    window: AdjustmentSummary  #: sliding-window optimisation; not usable if none ran


@dataclass(frozen=True)
class LoopSearchSummary:
    """The attempts to close a loop so far, and why there are no more loops; str(): in a line."""

    searches: int
    accepted: int
    without_candidate: int  #: too few objects, or no pose brings enough of them together
    refused: Dict[str, int]  #: counts by LoopClosure.reason
    #: False: the cameras turn about another axis than `up`, so nothing is found
    up_axis_is_plausible: bool
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Improvement:
    """Probability that the refined trajectory is nearer to the truth than the odometry; 0: not
    judged."""

    horizontal: float
    height: float


@dataclass(frozen=True)
class NoiseScale:
    """Learnt factors on the standard deviations of the detector."""

    radial: float
    lateral: float
    vertical: float
    yaw: float


@dataclass(frozen=True)
class StageTimes:
    """Times of one stage over a run [ms]."""

    count: int
    mean: float
    p50: float
    p95: float
    max: float


@dataclass(frozen=True, eq=False, repr=False)
class AsyncReport(_Compact):
    """What an AsyncMapper has done since it was last asked."""

    changes: MapChanges
    frames: int  #: frames that were added
    dropped: int  #: frames that found the queue full
    refused: int  #: frames that Mapper.add_frame would raise BadInputError for
    refusal: str  #: the message of the last of these
    failure: str  #: what ended the thread; empty: it runs


@dataclass(frozen=True, eq=False, repr=False)
class PoseGraph(_Compact):
    """V poses and E relative measurements between them. Arrays are converted and checked when it is
    made."""

    ids: np.ndarray  #: [V] ids of the vertices; of a mapper's graph: frame numbers
    poses: np.ndarray  #: [V, 4, 4] T_world_vertex [m]
    fixed: np.ndarray  #: [V] bool: keeps its pose
    edges: np.ndarray  #: [E, 2] ids from, to
    measurements: np.ndarray  #: [E, 4, 4] T_from_to [m]
    #: [E, 6, 6] information of Log(T_from_to^-1 T_world_from^-1 T_world_to), [translation,
    #: rotation]

    information: np.ndarray
    loops: np.ndarray  #: [E] bool: a loop, which a robust solve may refuse; other edges are trusted
    planar: bool = False  #: read from a file of SE2 rows alone: z, roll and pitch are zero

    def __post_init__(self) -> None:
        vertices, edges = len(self.ids), len(self.edges)
        shapes = {
            "ids": (vertices,),
            "poses": (vertices, 4, 4),
            "fixed": (vertices,),
            "edges": (edges, 2),
            "measurements": (edges, 4, 4),
            "information": (edges, 6, 6),
            "loops": (edges,),
        }
        kinds = {"ids": np.int32, "edges": np.int32, "fixed": np.bool_, "loops": np.bool_}
        for name, shape in shapes.items():
            value = getattr(self, name)
            if len(value) != shape[0]:
                raise UsageError(f"{name} has {len(value)} rows, expected {shape[0]}")
            if np.size(value) == 0:
                value = np.zeros(shape)
            object.__setattr__(self, name, array(name, value, shape, kinds.get(name, np.float64)))

    def g2o(self) -> str:
        """The text of a .g2o file (`VERTEX_SE3:QUAT`, `FIX`, `EDGE_SE3:QUAT`)."""
        return _core.g2o_text(self)


@dataclass(frozen=True, eq=False, repr=False)
class GraphSolution(_Compact):
    """An optimised pose graph."""

    graph: PoseGraph
    kept: np.ndarray  #: [E] bool: False for a loop that a robust solve has refused
    converged: bool
    iterations: int
    components: int  #: connected parts; a part without a fixed vertex keeps its first one
    chi2_before: float  #: of all edges, or of the kept ones
    chi2_after: float
    chordal_start: bool  #: the chordal start was used
    message: str


@dataclass(frozen=True)
class ErrorStats:
    """Statistics of a list of errors, in its unit; `std` is divided by the count, as in evo."""

    rmse: float
    mean: float
    median: float
    std: float
    max: float
    count: int


@dataclass(frozen=True, eq=False, repr=False)
class AteResult(_Compact):
    """Absolute trajectory error: distances of positions after alignment."""

    error: ErrorStats  #: [m]
    alignment: str
    scale: float  #: the alignment: x_ref = scale R x_est + t
    T_ref_est: np.ndarray  #: [4, 4] R and t
    unique: bool  #: False: the positions do not determine the alignment
    errors: np.ndarray  #: [N] per pose [m]


@dataclass(frozen=True)
class RpeResult:
    """Relative pose error."""

    translation: ErrorStats  #: [m]
    rotation: ErrorStats  #: [rad]


@dataclass(frozen=True, eq=False, repr=False)
class Hypothesis(_Compact):
    """A pose that the local layout may have in the global one."""

    yaw: float  #: p_global = Rz(yaw) p_local + t [rad]
    T_global_local: np.ndarray  #: [4, 4] the same as a matrix [m]
    matches: np.ndarray  #: [M, 2] matched objects: index in the local and in the global layout
    score: float  #: log likelihood ratio of the layout under the pose [nats]
    sigma: float  #: horizontal standard deviation per axis of the matched objects [m]


@dataclass(frozen=True)
class SiteCandidate:
    """A map that a stretch of a drive may be from, and where: a point p of the stretch is at
    Rz(yaw) p + (x, y) of the map's layout, to about a metre."""

    site: int  #: number in the index
    name: str
    score: float  #: log likelihood ratio of the objects under the pose, against chance [nats]
    matches: int  #: objects of the stretch with one of the map at their place
    yaw: float  #: [rad]
    x: float  #: [m]
    y: float


@dataclass(frozen=True, eq=False, repr=False)
class MatchResult(_Compact):
    """The pose of the local layout in the global one, or the reason of the refusal."""

    decision: str  #: "accepted", "ambiguous" or "none"
    reason: str
    score: float  #: log odds of the best pose [nats]
    second_score: float
    hypotheses: List[Hypothesis]  #: distinct poses, best first; may be empty

    @property
    def accepted(self) -> bool:
        return self.decision == "accepted"
