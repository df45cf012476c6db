# SPDX-License-Identifier: BSD-3-Clause
"""What a build has done, and its progress."""

import json
import sys
import time
from dataclasses import asdict, dataclass, field
from typing import Any, Callable, Dict, List, Optional, TextIO

from .tasks import Record

#: Called with the name of a stage and the record of a task that has ended.
Watch = Callable[[str, Record], Any]


@dataclass
class StageStatistics:
    """The tasks of one stage."""

    stage: str
    tasks: int = 0  #: that have ended
    reused: int = 0  #: whose output was there already
    failed: int = 0
    skipped: int = 0  #: that were not necessary
    cpu_s: float = 0.0  #: processor time of the tasks
    task_s: float = 0.0  #: their time on the clock, summed up
    longest_s: float = 0.0  #: processor time of the longest one
    wall_s: float = 0.0  #: of the stage
    bytes: int = 0  #: of the outputs

    def add(self, record: Record) -> None:
        """Counts a task that has ended."""
        self.tasks += 1
        self.reused += bool(record.get("reused"))
        self.failed += bool(record["error"])
        self.cpu_s += record.get("cpu_s", 0.0)
        self.longest_s = max(self.longest_s, record.get("cpu_s", 0.0))
        self.task_s += record.get("wall_s", 0.0)
        self.bytes += record.get("bytes", 0)


@dataclass
class FleetReport:
    """What a build has made: report.json."""

    version: str
    settings: Dict[str, Any]
    #: name, url, map of each drive that was mapped
    drives: List[Dict[str, str]] = field(default_factory=list)
    #: name, url, error of each drive that was left out
    quarantined: List[Dict[str, str]] = field(default_factory=list)
    #: map, drives, landmarks, loops, frames of each site
    sites: List[Dict[str, Any]] = field(default_factory=list)
    #: drives and error of sites whose maps could not be merged
    failed_sites: List[Dict[str, Any]] = field(default_factory=list)
    #: query, target and error of pairs that could not be verified, whose drives no other pair connects
    failed_pairs: List[Dict[str, str]] = field(default_factory=list)
    stages: List[StageStatistics] = field(default_factory=list)
    watch: Optional[Watch] = field(default=None, repr=False)  #: of build_fleet

    @property
    def complete(self) -> bool:
        """Whether every drive is in the map of a site, and no pair that failed may join two sites."""
        return not (self.quarantined or self.failed_sites or self.failed_pairs)

    def json(self) -> str:
        """The text of report.json."""
        names = ("version", "settings", "drives", "quarantined", "sites", "failed_sites")
        told = {name: getattr(self, name) for name in (*names, "failed_pairs")}
        return json.dumps({**told, "stages": [asdict(s) for s in self.stages]}, indent=2) + "\n"

    def sites_json(self) -> str:
        """The text of sites.json: what is the same whenever the same drives are built."""
        keys = ("name", "map", "drives", "landmarks", "loops", "frames")
        sites = [{key: site[key] for key in keys} for site in self.sites]
        return json.dumps({"version": self.version, "sites": sites}, indent=2) + "\n"


class Progress:
    """Lines about a stage: on a terminal one that is rewritten, otherwise one for each tenth."""

    def __init__(
        self,
        statistics: StageStatistics,
        total: int,
        stream: Optional[TextIO] = None,
        watch: Optional[Watch] = None,
    ) -> None:
        self.statistics, self._total, self._watch = statistics, total, watch
        self._stream = stream or sys.stderr
        self._begin = time.perf_counter()
        self._shown = -1
        self._terminal = self._stream.isatty()

    def ended(self, record: Record) -> None:
        """Counts a task."""
        self.statistics.add(record)
        if self._watch is not None:
            self._watch(self.statistics.stage, record)
        self._show(False)

    def skipped(self) -> None:
        """Counts a task that is not necessary."""
        self.statistics.skipped += 1
        self._show(False)

    def close(self) -> None:
        """The stage is over."""
        self.statistics.wall_s = time.perf_counter() - self._begin
        self._show(True)

    def _show(self, last: bool) -> None:
        now = self.statistics
        done = now.tasks + now.skipped
        step = 10 * done // max(self._total, 1)
        if not last and not self._terminal and (step == self._shown or done == self._total):
            return
        self._shown = step
        line = f"{now.stage}: {done} of {self._total}, {now.reused} were there"
        line += f", {now.skipped} not necessary" if now.skipped else ""
        line += f", {now.failed} failed" if now.failed else ""
        line += f", {time.perf_counter() - self._begin:.1f} s"
        end = "\n" if last or not self._terminal else ""
        begin = "\r\x1b[K" if self._terminal else ""
        self._stream.write(f"{begin}{line}{end}")
        self._stream.flush()
