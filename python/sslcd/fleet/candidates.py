# SPDX-License-Identifier: BSD-3-Clause
"""Which pairs of drives are worth to be compared: by an index of the layouts of all maps."""

import json
import os
from itertools import combinations
from typing import Dict, Iterable, List, Sequence, Tuple

import numpy as np

from ..layouts import Layout
from ..map_results import MapInfo, MapResults
from ..maps import Map
from ..sites import SiteIndex
from .content import local_copy, place, publish, publish_text, read_json, scratch
from .settings import FleetSettings
from .tasks import Record, measured

#: Names of the drive that is localised, and of that whose map it is looked for in.
Pair = Tuple[str, str]

MAPS_PER_INDEX = 1000  # an index is one task
STRETCH_M, STEP_M = 100.0, 50.0  # of path, as SiteIndex.find expects


def all_pairs(names: Sequence[str]) -> List[Pair]:
    """Every drive with every other one, once."""
    return [(query, target) for target, query in combinations(names, 2)]


def _layout(results: MapResults, info: MapInfo, frames: Iterable[int]) -> Layout:
    """The confirmed landmarks that these frames have seen."""
    wanted = np.fromiter(frames, int)
    seen = [o for o in results.objects if np.isin(o.observations[:, 0], wanted).any()]
    return Layout.of_objects(seen, info.labels, info.up)


def _read(record: Record) -> Tuple[MapResults, MapInfo]:
    with local_copy(record["map"]) as path:
        return Map(path).results, Map(path).info


def index_maps(records: List[Record], out: str, settings: FleetSettings) -> Record:
    """Writes an index of the maps of drives. The record has its path and key."""

    def work() -> Record:
        key = settings.key("index", [each["key"] for each in records])
        path = place(out, "index", key)
        record = {"index": path, "key": key, "reused": os.path.exists(path)}
        if not record["reused"]:
            sites: Dict[str, Layout] = {}
            for each in records:
                results, info = _read(each)
                sites[each["name"]] = Layout.of_objects(results.objects, info.labels, info.up)
            with scratch() as folder:
                SiteIndex.build(os.path.join(folder, "index"), sites)
                publish(os.path.join(folder, "index"), path)
        return {**record, "bytes": os.path.getsize(path)}

    return {"first": records[0]["name"], **measured(work)}


def rank_maps(record: Record, indices: List[Record], out: str, settings: FleetSettings) -> Record:
    """The maps that a drive may share a place with: names and scores [nats], best first."""

    def work() -> Record:
        most = settings.candidates
        key = settings.key("rank", record["key"], [each["key"] for each in indices], most)
        path = place(out, "pairs", f"{key}.json")
        if os.path.exists(path):
            return {**read_json(path), "reused": True}
        scores: Dict[str, float] = {}
        stretches = _stretches(record)
        for index in (SiteIndex(each["index"]) for each in indices):
            for stretch in stretches:
                for one in index.find(stretch, most + 1):  # the drive itself is among them
                    if one.name != record["name"]:
                        scores[one.name] = max(scores.get(one.name, one.score), one.score)
        ranked = sorted(scores.items(), key=lambda item: (-item[1], item[0]))[:most]
        publish_text(json.dumps({"ranked": ranked}), path)
        return {"ranked": ranked}

    return {"name": record["name"], **measured(work)}


def _stretches(record: Record) -> List[Layout]:
    """What a drive has seen on each 100 m of its path; every half of it another one begins."""
    results, info = _read(record)
    path = results.trajectories[record["name"]]
    steps = np.linalg.norm(np.diff(path.positions, axis=0), axis=1)
    travelled = np.concatenate([[0.0], np.cumsum(steps)])
    begins = np.arange(0, max(travelled[-1] - STEP_M, 1), STEP_M)
    return [
        _layout(results, info, path.frames[(travelled >= at) & (travelled < at + STRETCH_M)])
        for at in begins
    ]


def pairs_of(ranked: Iterable[Record]) -> List[Pair]:
    """The pairs of all ranks, each once, the best first."""
    best: Dict[Pair, float] = {}
    for record in ranked:
        for name, score in record["ranked"]:
            pair = (max(record["name"], name), min(record["name"], name))
            best[pair] = max(best.get(pair, score), score)
    return sorted(best, key=lambda pair: (-best[pair], pair))
