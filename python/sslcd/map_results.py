# SPDX-License-Identifier: BSD-3-Clause
"""What a map in a file holds. Values are copies."""

from dataclasses import dataclass
from typing import Dict, List, Optional

import numpy as np

from .compact import _Compact
from .inputs import Camera
from .results import LoopClosure, MapObject, MapPart, NoiseScale, PoseGraph, Trajectory


@dataclass(frozen=True)
class SessionInfo:
    """One drive of a site, as its map describes it."""

    name: str
    ended: bool  #: False: interrupted, or still in work
    frames: int
    frame_offset: int  #: added to the number of a frame in its drive: its number in the map
    inputs: int  #: frames, starts of sequences and refinements
    checksum: str  #: SHA-256 over the inputs, hexadecimal: the same for the same drive
    dataset: str  #: where it comes from, for people
    command: str
    program: str
    started: str  #: UTC


@dataclass(frozen=True, eq=False, repr=False)
class MapInfo(_Compact):
    """What a map is about."""

    up: np.ndarray  #: [3] unit vector in the world
    labels: Dict[str, str]  #: symmetry by label: of the datasets, and all labels seen
    camera: Optional[Camera]  #: whose 2D boxes are used
    vector_lengths: Dict[str, int]  #: of the appearance vectors, by cue; 0: none seen
    config: str  #: the mapper's options as YAML
    created: str  #: UTC
    sessions: List[SessionInfo]
    file_bytes: int


@dataclass(frozen=True, eq=False, repr=False)
class MapResults(_Compact):
    """The results that a map holds. Frames have the numbers of the map."""

    trajectories: Dict[str, Trajectory]  #: T_world_cam of each session's frames, by its name
    odometry: Dict[str, Trajectory]  #: T_odom_cam of the same frames
    objects: List[MapObject]  #: all landmarks by id; the confirmed ones are the map
    loops: List[LoopClosure]  #: all attempts in order
    parts: List[MapPart]  #: by number; which of them have a common map
    graph: PoseGraph
    scale: float  #: metres per odometry metre
    noise_scale: NoiseScale


@dataclass(frozen=True, eq=False, repr=False)
class Localisation(_Compact):
    """The answer of an attempt to find a camera in a map. Poses are None where nothing in the map
    fits better than chance."""

    frame: int  #: number of the frame
    decision: str  #: "accepted": it is found; "ambiguous": not surely enough; "none"
    reason: str  #: why it was accepted or refused
    score: float  #: log odds that the pose is right [nats]
    probability: float  #: that the pose is right
    T_map_cam: Optional[np.ndarray]  #: [4, 4] pose of the camera in the map's world [m]
    #: [4, 4] corrects the next frames: T_map_cam = T_map_odom T_odom_cam, where the translation of
    #: T_odom_cam is that of the odometry times MapResults.scale
    T_map_odom: Optional[np.ndarray]
    #: [6, 6] of the right perturbation T_map_cam Exp(d), d = [translation, rotation] [m, rad]
    covariance: Optional[np.ndarray]
    travelled: float  #: path since the first frame [m]
    objects_in_view: int  #: objects of the local map
    pairs: np.ndarray  #: [M, 2] matched landmark ids: of this drive, and of the map

    @property
    def accepted(self) -> bool:
        """Whether the camera is found."""
        return self.decision == "accepted"


@dataclass(frozen=True, eq=False, repr=False)
class PlaceHistory(_Compact):
    """A place where an object has stood in some of the S sessions of a map (docs/change.md)."""

    landmarks: np.ndarray  #: [M] ids; that with most sightings first
    label: str  #: of the first landmark, as pose and size
    T_world_object: np.ndarray  #: [4, 4] [m]
    dims: np.ndarray  #: [3] length, width, height [m]
    map: int  #: MapPart.joined_with
    seen: np.ndarray  #: [S] frames with a detection
    expected: np.ndarray  #: [S] frames that should have one if an object was there, on average
    probability: np.ndarray  #: [S] that an object was there, by all sessions


@dataclass(frozen=True)
class ChangeRates:
    """How often the places of a label change from one session to the next: probabilities."""

    departure: float  #: that an object leaves
    replaced: float  #: that another one stands there in the next session, if it has left
    arrival: float  #: that an object comes to an empty place


@dataclass(frozen=True)
class PlaceOutcome:
    """What became of a place between two sessions: probabilities, of sum 1."""

    stayed: float  #: the same object is there
    departed: float  #: an object was there, and none is
    replaced: float  #: another object is there
    arrived: float  #: none was there, and one is
    empty: float  #: none was there, and none is


@dataclass(frozen=True)
class PlaceChange:
    """A place that has changed from one session to a later one."""

    kind: str  #: "departed", "arrived" or "replaced"
    probability: float
    place: int  #: index in MapHistory.places


@dataclass(frozen=True, eq=False, repr=False)
class MapDiff(_Compact):
    """What has changed between two sessions of a map."""

    before: str  #: names of the two sessions
    after: str
    changes: List[PlaceChange]  #: by kind, the most probable first
    stayed: int  #: places in view of both sessions where the same object is
    unknown: int  #: other places in view of both, where something was in one of them
    unseen: int  #: places with something in one session that the other one has not seen


@dataclass(frozen=True)
class MergedSession:
    """A session that a merge has added."""

    map: str  #: file that it comes from
    old_name: str  #: in that file
    name: str  #: in the merged map
    frames: int


@dataclass(frozen=True)
class MergeReport:
    """What a merge has done."""

    added: List[MergedSession]
    left_out: List[str]  #: sessions that have not been ended, as "FILE: NAME"
