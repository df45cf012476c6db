# SPDX-License-Identifier: BSD-3-Clause
"""The stages of a build: map each drive, candidate pairs, verify them, components, solve each."""

import os
from typing import Dict, Iterator, List, Optional, Sequence

from distributed import Client

from .. import _core
from ..errors import BadInputError, NoSolutionError, UsageError
from .candidates import MAPS_PER_INDEX, Pair, all_pairs, index_maps, pairs_of, rank_maps
from .cluster import check_workers
from .components import Components
from .content import FOLDERS, publish_text, writing
from .drives import Drive
from .report import FleetReport, Progress, StageStatistics, Watch
from .run_tasks import Task, in_order, run_tasks
from .settings import FleetSettings
from .tasks import Record, map_drive, solve_site, verify_pair


def build_fleet(
    drives: Sequence[Drive],
    out: str,
    client: Client,
    settings: FleetSettings = FleetSettings(),
    watch: Optional[Watch] = None,
) -> FleetReport:
    """Maps drives, finds out which are of one site, and merges those.

    Outputs are named by what they are made from and appear as a whole, so a build that was ended may
    be started again, and only does what is missing; drives may be added. The result does not depend
    on the number of workers, nor on when they are killed.

    Args:
        drives: of find_drives(), with different names.
        out: a folder that all workers see. It gets sites.json, report.json, and maps.
        client: of a Dask cluster whose workers have the same version of sslcd.
        settings: options of the mapper and of the drives' files.
        watch: called with the name of the stage and the record of each task when it ends.

    Raises:
        OutputError: `out` cannot be written.
        UsageError: no drives, workers of another version, files outside the drives.
        BadInputError: no drive could be mapped.
        NoSolutionError: the scheduler was lost, or the maps could not be ranked.
    """
    if not drives:
        raise UsageError("no drive is given")
    settings.files()  # raises what is wrong with them
    out = os.path.abspath(out)
    make_folders(out)
    check_workers(client, out)
    report = FleetReport(_core.__version__, settings.for_report(), watch=watch)
    maps = _map_drives(drives, out, client, settings, report)
    if maps:
        components = _verify(maps, out, client, settings, report)
        _solve(maps, components.groups(), out, client, settings, report)
    with writing(out):
        publish_text(report.json(), os.path.join(out, "report.json"))
    if not maps:
        raise BadInputError(
            f"none of the {len(drives)} drives could be mapped, e.g. "
            f"{report.quarantined[0]['name']}: {report.quarantined[0]['error']}; report.json in "
            f"{out} has all errors"
        )
    with writing(out):
        publish_text(report.sites_json(), os.path.join(out, "sites.json"))
    return report


def make_folders(out: str) -> None:
    """The folders of the outputs. Raises OutputError."""
    with writing(out):
        for folder in FOLDERS:
            os.makedirs(os.path.join(out, folder), exist_ok=True)


def _stage(report: FleetReport, name: str, total: int) -> Progress:
    statistics = StageStatistics(name)
    report.stages.append(statistics)
    return Progress(statistics, total, watch=report.watch)


def _map_drives(
    drives: Sequence[Drive], out: str, client: Client, settings: FleetSettings, report: FleetReport
) -> List[Record]:
    """The records of the drives that have a map, by name; the others are put into quarantine."""
    tasks: Iterator[Task] = (
        ({"name": drive.name, "url": drive.url}, map_drive, (drive, out, settings))
        for drive in drives
    )
    progress = _stage(report, "map", len(drives))
    maps: List[Record] = []
    by_content: Dict[str, Record] = {}
    for record in in_order(run_tasks(client, tasks, progress), "name"):
        error = record["error"]
        if not error:
            twin = by_content.setdefault(record["content"], record)
            if twin is not record:
                error = (
                    f"has the same files as {twin['url']}: the same recording, which counts once"
                )
        if error:
            names = {key: record[key] for key in ("name", "url")}
            report.quarantined.append({**names, "error": error})
        else:
            maps.append(record)
            names = {key: record[key] for key in ("name", "url", "map")}
            report.drives.append({**names, "map": os.path.relpath(record["map"], out)})
    return maps


def _candidates(
    maps: List[Record], out: str, client: Client, settings: FleetSettings, report: FleetReport
) -> List[Pair]:
    """The pairs of drives that are to be compared, the most promising first."""
    if not 0 < settings.candidates < len(maps) - 1:
        return all_pairs([record["name"] for record in maps])
    shards = [maps[i : i + MAPS_PER_INDEX] for i in range(0, len(maps), MAPS_PER_INDEX)]
    index: Iterator[Task] = (
        ({"first": shard[0]["name"]}, index_maps, (shard, out, settings)) for shard in shards
    )
    indices = _all(run_tasks(client, index, _stage(report, "index", len(shards))), "first")
    rank: Iterator[Task] = (
        ({"name": record["name"]}, rank_maps, (record, indices, out, settings)) for record in maps
    )
    return pairs_of(_all(run_tasks(client, rank, _stage(report, "rank", len(maps))), "name"))


def _all(records: Iterator[Record], name: str) -> List[Record]:
    """The records in order. Without one of them the sites could not be told, so it must be there."""
    ordered = in_order(records, name)
    for record in ordered:
        if record["error"]:
            raise NoSolutionError(
                f"the maps could not be compared, at {record[name]}: {record['error']}; the same "
                "command goes on, --candidates 0 does without the index"
            )
    return ordered


def _verify(
    maps: List[Record], out: str, client: Client, settings: FleetSettings, report: FleetReport
) -> Components:
    """Which drives are connected by pairs that are sure. A pair of drives that are connected
    already is not compared: it could not change the components, so they do not depend on the order
    in which tasks end."""
    by_name = {record["name"]: record for record in maps}
    components = Components(by_name)
    pairs = _candidates(maps, out, client, settings, report)

    def tasks() -> Iterator[Optional[Task]]:
        for pair in pairs:
            yield None if components.connected(*pair) else _verification(pair)

    def _verification(pair: Pair) -> Task:
        query, target = (by_name[name] for name in pair)
        return {"query": pair[0], "target": pair[1]}, verify_pair, (query, target, out, settings)

    progress = _stage(report, "verify", len(pairs))
    failed: List[Record] = []
    for record in run_tasks(client, tasks(), progress):
        if record["error"]:
            failed.append({key: record[key] for key in ("query", "target", "error")})
        elif record["joined"]:
            components.connect(record["query"], record["target"])
    failed.sort(key=lambda pair: (pair["query"], pair["target"]))
    report.failed_pairs += [
        pair for pair in failed if not components.connected(pair["query"], pair["target"])
    ]
    return components


def _solve(
    maps: List[Record],
    groups: List[List[str]],
    out: str,
    client: Client,
    settings: FleetSettings,
    report: FleetReport,
) -> None:
    """Merges the maps of each group. One that does not become a single map is solved by parts."""
    by_name = {record["name"]: record for record in maps}
    progress = _stage(report, "solve", len(groups))
    while groups:
        # the longest tasks first, so that none is left over at the end
        groups = sorted(groups, key=lambda group: -sum(by_name[n]["bytes"] for n in group))
        tasks: Iterator[Task] = (
            ({"drives": group}, solve_site, ([by_name[name] for name in group], out, settings))
            for group in groups
        )
        again: List[List[str]] = []
        for record in run_tasks(client, tasks, progress):
            if record["error"]:
                report.failed_sites.append({key: record[key] for key in ("drives", "error")})
            elif len(record["groups"]) > 1:
                again += record["groups"]
            else:
                report.sites.append(_site(record, out))
        groups = again
    report.sites.sort(key=lambda site: site["name"])


def _site(record: Record, out: str) -> Record:
    numbers = {key: record[key] for key in ("landmarks", "loops", "frames")}
    path = os.path.relpath(record["map"], out)
    return {"name": record["drives"][0], "map": path, "drives": record["drives"], **numbers}
