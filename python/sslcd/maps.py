# SPDX-License-Identifier: BSD-3-Clause
"""Maps in files (docs/store.md): what they hold, new sessions, where a drive is, what has changed."""

import os
from typing import Any, Callable, Iterable, List, Mapping, Optional, Sequence, Union

from numpy.typing import ArrayLike

from . import _core
from .datasets import Dataset
from .errors import UsageError
from .frame_taker import FrameTaker
from .inputs import Camera, Frame, checked
from .map_history import MapHistory
from .map_results import (
    Localisation,
    MapDiff,
    MapInfo,
    MapResults,
    MergeReport,
    SessionInfo,
)
from .mapper import KITTI_UP, Mapper, context
from .mapper import _wrap as _wrap_mapper
from .options import Options, settings
from .results import AdjustmentSummary, FrameReport

Path = Union[str, "os.PathLike[str]"]


class Map:
    """A map of a site in a file. Each drive through the site is a session of the map.

    The object holds the file's name only: every call opens the file, sees one state of it, and
    closes it. It may be pickled, and used while another process writes.

    Args:
        path: of the file; the first session makes it.

    Raises:
        BadInputError: by all calls, for a file that is missing, damaged, or no map.
        OutputError: by those that write, e.g. on a full disk, or while another process writes.
    """

    def __init__(self, path: Path) -> None:
        self.path = os.fspath(path)

    def __repr__(self) -> str:
        return f"Map({self.path!r})"

    @property
    def exists(self) -> bool:
        """Whether the file is there and has a session."""
        return _core.has_map(self.path)

    @property
    def info(self) -> MapInfo:
        """Up axis, labels, camera, options, sessions."""
        return _core.map_info(self.path)

    @property
    def sessions(self) -> List[SessionInfo]:
        """The drives in the order in which they were begun."""
        return self.info.sessions

    @property
    def results(self) -> MapResults:
        """Trajectories, landmarks, loops, pose graph. Raises BadInputError if their checksum is
        wrong."""
        return _core.map_results(self.path)

    def frames(self, session: str) -> List[Frame]:
        """The frames of a session as they were added, without the paths of their images."""
        return _core.map_frames(self.path, session)

    def verify(self) -> List[str]:
        """Reads the whole file and compares all checksums. A sentence per problem; empty: it is
        sound."""
        return _core.verify_map(self.path)

    def start_session(
        self,
        name: str,
        *,
        labels: Optional[Mapping[str, str]] = None,
        up: ArrayLike = KITTI_UP,
        camera: Optional[Camera] = None,
        options: Optional[Options] = None,
        dataset: Path = "",
    ) -> "MapSession":
        """Begins a session; makes the file if there is none.

        Args:
            name: unlike those of the other sessions.
            labels, up, camera: as of a Mapper. They have to agree with those of the map; a session
                with another camera is mapped without 2D boxes.
            options: nested dict with the keys of docs/configuration.md; None: those of the map, or
                the defaults if it is new.
            dataset: where the drive comes from, for people.

        Raises:
            UsageError: the name is taken, another session has not been ended, or the options are
                not those of the map.
            BadInputError: another up axis, or another symmetry of a label: the map is of another
                site.
        """
        given = context(labels, up, camera)
        texts = None if options is None else settings(options)
        core = _core.begin_session(self.path, name, os.fspath(dataset), given, texts)
        return MapSession(core)

    def resume_session(
        self,
        *,
        labels: Optional[Mapping[str, str]] = None,
        up: ArrayLike = KITTI_UP,
        camera: Optional[Camera] = None,
    ) -> "MapSession":
        """Goes on with the session that has not been ended. `labels`, `up` and `camera` as before.
        Raises UsageError if there is none."""
        return MapSession(_core.resume_session(self.path, context(labels, up, camera)))

    def add(
        self,
        drive: Dataset,
        name: str = "",
        options: Optional[Options] = None,
        *,
        progress: Optional[Callable[[int, int], Any]] = None,
    ) -> SessionInfo:
        """Adds a whole drive as a session, as `sslcd_run run DRIVE --map FILE` does.

        Args:
            drive: of load_dataset(); its images are not used.
            name: of the session; empty: that of the drive.
            options: as of start_session.
            progress: called with the numbers of frames done and of all.
        """
        checked("drive", drive, Dataset)
        session = self.start_session(
            name or drive.name,
            labels=drive.labels,
            up=drive.up,
            camera=drive.camera,
            options=options,
            dataset=drive.path,
        )
        with session:
            for number, frame in enumerate(drive, 1):
                session.add(frame)
                if progress is not None:
                    progress(number, len(drive))
        return self.sessions[-1]

    def localise(
        self,
        frames: Union[Dataset, Iterable[Frame]],
        *,
        camera: Optional[Camera] = None,
        first: bool = False,
    ) -> List[Localisation]:
        """Where a drive, or a stretch of it, is in the map, without any prior pose. The map is only
        read.

        Args:
            frames: in order of time. Up axis and labels of a Dataset have to be those of the map.
            camera: for frames with boxes; None: that of a Dataset.
            first: stop at the first answer that is accepted.

        Returns:
            an answer every few metres, and one at the end.
        """
        given = frames if isinstance(frames, Dataset) else None
        localiser = Localiser(
            self,
            labels=given.labels if given else None,
            up=given.up if given else None,
            camera=camera or (given.camera if given else None),
        )
        answers: List[Localisation] = []
        count, answered = 0, True
        for frame in frames:
            answer = localiser.add(frame)
            count, answered = count + 1, answer is not None
            if answer is not None:
                answers.append(answer)
                if first and answer.accepted:
                    return answers
        if count and not answered:
            answers.append(localiser.attempt())
        return answers

    @property
    def history(self) -> "MapHistory":
        """What was there when, in each session (docs/change.md)."""
        return MapHistory(_core.MapHistory(self.path))

    def diff(self, before: str = "", after: str = "") -> MapDiff:
        """What has changed between two sessions, by their names. Empty: `after` is the last session,
        `before` the last one before it, that have a place in view in common.

        Raises:
            UsageError: an unknown name, the wrong order, or a map of one session.
            NoSolutionError: no place was in view of both.
        """
        return _core.compare_sessions(self.path, before, after)

    def merge(
        self,
        others: Union["Map", Path, Sequence[Union["Map", Path]]],
        *,
        out: Path = "",
        rename: bool = False,
        refine_once: bool = False,
        progress: Optional[Callable[[int, int], Any]] = None,
    ) -> MergeReport:
        """Adds the ended sessions of other maps, as if their drives had been recorded in this one.
        All or nothing, also if the process is killed.

        Args:
            others: one or several maps; they are only read.
            out: a new file for the merged map; empty: this map itself.
            rename: a session whose name is taken becomes NAME-2; otherwise it is refused.
            refine_once: one refinement after the last session instead of one for each: quicker, for
                many maps. The map is no longer that of drives recorded in it one after another.
            progress: as of add(). ctrl-C and its exceptions end the merge, and the map stays.

        Raises:
            UsageError, BadInputError: as start_session; a session that is there already.
        """
        listed: Any = [others] if isinstance(others, (Map, str, os.PathLike)) else others
        paths = [each.path if isinstance(each, Map) else os.fspath(each) for each in listed]
        return _core.merge_maps(
            self.path, paths, os.fspath(out), bool(rename), bool(refine_once), progress
        )

    def export(self, folder: Path) -> List[str]:
        """As `sslcd_run map export`. The same results give the same bytes. Returns the paths."""
        return _core.export_map(self.path, os.fspath(folder))

    def compact(self) -> None:
        """Updates an older schema and returns unused space to the disk."""
        _core.compact_map(self.path)


class MapSession(FrameTaker[FrameReport]):
    """A drive that is added to a map in a file: Map.start_session() or Map.resume_session().

    As a context manager it refines (unless the map's options say `refine.enabled: false`) and ends
    the session where its block ends. If the block raises, what there is is stored and the session
    stays open, for Map.resume_session().

    Frames are stored in batches: what `stored_frames` counts survives a killed process and a loss
    of power.
    """

    def __init__(self, core: Any) -> None:
        super().__init__(core)

    def __enter__(self) -> "MapSession":
        return self

    def __exit__(self, kind: Any, value: Any, trace: Any) -> None:
        if self._core.closed():
            return
        try:
            if kind is None:
                if self._core.refines():
                    self.refine()
                self.end()
            else:
                self.save()
        finally:
            self._core.close()

    def is_stored(self, frame: Frame) -> bool:
        """Whether this frame is stored already, by its number. Raises BadInputError if it was stored
        with another content: the drive is another one, or has changed."""
        return self._core.is_stored(checked("frame", frame, Frame))

    def refine(self, at_end: bool = True) -> AdjustmentSummary:
        """Optimises the whole map, as Mapper.refine."""
        return self._core.refine(bool(at_end))

    def save(self) -> None:
        """Stores all frames so far and the present results."""
        self._core.save()

    def end(self) -> None:
        """Stores everything; the session is over and the file closed. It does not refine."""
        self._core.end()

    def close(self) -> None:
        """Closes the file. What is not stored is lost; the session can be resumed."""
        self._core.close()

    @property
    def info(self) -> SessionInfo:
        """The session so far."""
        return self._core.info()

    @property
    def stored_frames(self) -> int:
        """Number of frames of this session that will not be lost."""
        return self._core.stored_frames()

    @property
    def mapper(self) -> Mapper:
        """A copy of the mapper, with all sessions; frames have the numbers of the map."""
        core = self._core.mapper()
        return _wrap_mapper(core, 0)


class Localiser:
    """Finds a drive in a map, without any prior pose, and does not change the map. The last 75 m of
    the drive are compared with the whole map every 5 m, and attempts add up.

    Keeps the frames of the drive; begin another one for another drive. Threads may share one.

    Args:
        map: or the path of its file.
        labels, up: of the drive, to be compared with those of the map; None: not compared.
        camera: for frames with boxes.

    Raises:
        BadInputError: the map has no landmarks, or is of another site.
    """

    def __init__(
        self,
        map: Union[Map, Path],
        *,
        labels: Optional[Mapping[str, str]] = None,
        up: Optional[ArrayLike] = None,
        camera: Optional[Camera] = None,
    ) -> None:
        path = map.path if isinstance(map, Map) else os.fspath(map)
        if labels is not None and up is None:
            raise UsageError("labels are given without up: give both, or none")
        given = context(labels, KITTI_UP if up is None else up, camera)
        self._core = _core.Localiser(path, given, up is not None)

    def add(self, frame: Frame) -> Optional[Localisation]:
        """Adds the next frame in order of time. An answer about it if an attempt was made."""
        return self._core.add_frame(checked("frame", frame, Frame))

    def attempt(self) -> Localisation:
        """An attempt from the newest frame at once, e.g. of a robot that stands. Raises UsageError if
        there is no frame yet."""
        return self._core.attempt()
