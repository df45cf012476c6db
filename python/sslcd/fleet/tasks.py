# SPDX-License-Identifier: BSD-3-Clause
"""What workers do. A task takes and returns small values; maps are files. It does nothing if its
output is there, and what it raises is told as a record, since one drive must not end a build."""

import json
import os
import shutil
import sys
import time
from typing import Any, Callable, Dict, List, Sequence

from .. import _core
from ..datasets import load_dataset
from ..errors import BadInputError, Error, OutputError
from ..map_results import SessionInfo
from ..maps import Map
from ..results import MapPart
from . import drives
from .components import Components
from .content import cannot_write, local_copy, place, publish, publish_text, read_json, scratch
from .drives import Drive
from .settings import FleetSettings

Record = Dict[str, Any]


def measured(work: Callable[[], Record]) -> Record:
    """The record of some work with its times, and with its error. `fatal`: others would fail alike."""
    wall, cpu = time.perf_counter(), time.process_time()
    try:
        record = {"error": "", "fatal": False, "reused": False, **work()}
    except MemoryError:
        error = "needs more memory than its worker has; raise --memory"
        record = {"error": error, "fatal": False, "reused": False}
    except (Error, OSError) as problem:
        # a disk that is full or may not be written is nobody's drive's fault
        fatal = isinstance(problem, OutputError) or cannot_write(problem)
        record = {"error": f"{problem or type(problem).__name__}", "fatal": fatal, "reused": False}
    record["wall_s"] = time.perf_counter() - wall
    record["cpu_s"] = time.process_time() - cpu
    return record


def version() -> str:
    """Of sslcd on a worker."""
    return _core.__version__


def map_drive(drive: Drive, out: str, settings: FleetSettings) -> Record:
    """Maps a drive. The record has the content of its files, the map's key and path, its size."""

    def work() -> Record:
        content = drives.content_of(drive, settings.storage)
        key = settings.key("drive", drive.name, content)
        path = place(out, "drives", f"{key}.db")
        record: Record = {"content": content, "key": key, "map": path, "reused": True}
        if not os.path.exists(path):
            record["reused"] = False
            _make_map(drive, path, settings)
        record["bytes"] = os.path.getsize(path)
        return record

    return {"name": drive.name, "url": drive.url, **measured(work)}


def _make_map(drive: Drive, path: str, settings: FleetSettings) -> None:
    options = dict(text.split("=", 1) for text in settings.options)
    with drives.local_folder(drive, settings.storage) as folder, scratch() as work:
        for name, file in settings.files().items():
            if not os.path.exists(os.path.join(folder, file)):  # nor one in the worker's own folder
                raise BadInputError(f"{drive.url}: has no {file}; {name} must be in each drive")
        dataset = load_dataset(folder, **settings.dataset)  # type: ignore[arg-type]
        dataset.path = drive.url
        made = Map(os.path.join(work, "map.db"))
        made.add(dataset, drive.name, options)
        publish(made.path, path)


def verify_pair(query: Record, target: Record, out: str, settings: FleetSettings) -> Record:
    """Whether a drive has been where another one has: it is localised in the map of the latter, with
    the honest decision of relocalisation."""

    def work() -> Record:
        name = settings.key("pair", query["key"], target["key"])
        path = place(out, "pairs", f"{name}.json")
        if os.path.exists(path):
            return {**read_json(path), "reused": True}
        told = _localise(query, target)
        publish_text(json.dumps(told), path)
        return told

    return {"query": query["name"], "target": target["name"], **measured(work)}


def _localise(query: Record, target: Record) -> Record:
    with local_copy(query["map"]) as one, local_copy(target["map"]) as other:
        answers = Map(other).localise(Map(one).frames(query["name"]), first=True)
    if not answers:
        return {"joined": False, "reason": "no attempt", "probability": 0.0}
    last = answers[-1]
    told = {"joined": last.accepted, "reason": last.reason, "probability": last.probability}
    return {**told, "travelled_m": last.travelled, "attempts": len(answers)}


def solve_site(members: List[Record], out: str, settings: FleetSettings) -> Record:
    """Merges the maps of drives. The record has the drives by common map: more than one list means
    that they are of several sites after all, and then no map is published."""

    def work() -> Record:
        key = settings.key("site", [each["key"] for each in members])
        name = f"{key}.db"
        path, groups_path = place(out, "sites", name), place(out, "sites", f"{key}.json")
        if os.path.exists(groups_path):
            told: Record = {**read_json(groups_path), "reused": True}
        else:
            told = _merge(members, path, groups_path)
        told.update(key=key, map=path if len(told["groups"]) == 1 else "")
        told["bytes"] = os.path.getsize(path) if told["map"] else 0
        return told

    return {"drives": [each["name"] for each in members], **measured(work)}


def _merge(members: List[Record], path: str, groups_path: str) -> Record:
    with scratch() as folder:
        copies = [
            shutil.copyfile(each["map"], os.path.join(folder, f"{number}.db"))
            for number, each in enumerate(members)
        ]
        site = Map(copies[0])
        if len(copies) > 1:
            site.merge(copies[1:], refine_once=True)
        told = _groups(site)
        if len(told["groups"]) == 1:
            publish(site.path, path)
        publish_text(json.dumps(told), groups_path)  # last: it says that all is there
    return told


def _groups(site: Map) -> Record:
    """The sessions of a map by common map, and what the map has."""
    info, results = site.info, site.results
    landmarks = sum(each.state == "confirmed" for each in results.objects)
    loops = sum(each.accepted for each in results.loops)
    frames = sum(session.frames for session in info.sessions)
    return {
        "groups": groups_of(info.sessions, results.parts),
        "landmarks": landmarks,
        "loops": loops,
        "frames": frames,
    }


def groups_of(sessions: Sequence[SessionInfo], parts: Sequence[MapPart]) -> List[List[str]]:
    """Names of the sessions by common map. A session has several parts where its odometry was lost;
    two sessions have a common map if any of their parts have one."""
    ordered = sorted(sessions, key=lambda session: session.frame_offset)
    ends = [session.frame_offset for session in ordered[1:]] + [sys.maxsize]
    components = Components(session.name for session in sessions)
    first_of: Dict[int, str] = {}  # a session of each common map
    for session, end in zip(ordered, ends):
        for part in parts:
            if session.frame_offset <= part.first_frame < end:
                components.connect(
                    first_of.setdefault(part.joined_with, session.name), session.name
                )
    return components.groups()
