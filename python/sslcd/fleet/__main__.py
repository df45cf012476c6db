# SPDX-License-Identifier: BSD-3-Clause
"""python -m sslcd.fleet: maps of many drives. docs/fleets.md."""

import argparse
import os
import sys
from typing import Any, ContextManager, Dict, List, Optional

from distributed import Client

from ..errors import BadConfigError, BadInputError, Error, NoSolutionError, OutputError, UsageError
from ..options import complete_options
from .build import build_fleet
from .cluster import has_dashboard, local_client, remote_client
from .drives import find_drives
from .report import FleetReport
from .settings import FleetSettings

#: Exit codes, as of sslcd_run.
_CODES = {OutputError: 1, UsageError: 2, BadInputError: 3, BadConfigError: 4, NoSolutionError: 5}
_NOT_ALL = 3  # some drives were left out, or pairs of them not compared
_EXAMPLES = """examples:
  python -m sslcd.fleet build drives/* --out sites
  python -m sslcd.fleet build monday=/data/a/run tuesday=/data/b/run --out sites --workers 8
  python -m sslcd.fleet build 's3://bucket/drives/*' --out /shared/sites --scheduler tcp://head:8786
exit codes: 0 all drives are in a map, 3 some were left out or not compared (report.json says why), otherwise
as of sslcd_run: 1 output, 2 usage, 3 input, 4 configuration, 5 no solution (the scheduler was lost, maps could
not be ranked). The same command goes on with a build that was ended."""


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m sslcd.fleet", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    build = commands.add_parser(
        "build",
        help="map drives, find out which are of one site, merge those",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    build.add_argument(
        "drives",
        nargs="+",
        metavar="DRIVE",
        help="dataset folder: path, URL, pattern, NAME=FOLDER, @LIST",
    )
    build.add_argument("--out", required=True, help="folder of the outputs, which all workers see")
    where = build.add_mutually_exclusive_group()
    where.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="of a Dask cluster; default: a cluster on this machine",
    )
    where.add_argument(
        "--workers",
        type=int,
        default=os.cpu_count(),
        help="processes on this machine; default: %(default)s",
    )
    build.add_argument(
        "--memory", default="auto", help="most of each of them, e.g. 2GB; default: an equal share"
    )
    build.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="an option of the mapper, as sslcd_run takes it",
    )
    build.add_argument(
        "--candidates",
        type=int,
        default=10,
        help="drives that each one is compared with; default: %(default)s, 0: all",
    )
    build.add_argument("--format", default="", help="of the dataset folders, as of sslcd_run")
    for name in ("detections", "odometry"):
        build.add_argument(f"--{name}", default="", help="file or folder in each dataset folder")
    build.add_argument(
        "--storage",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="an option for fsspec, e.g. anon=true",
    )
    return parser


def _pairs(flag: str, texts: List[str]) -> Dict[str, Any]:
    pairs: Dict[str, Any] = {}
    for text in texts:
        key, equals, value = text.partition("=")
        if not key or not equals:
            raise UsageError(f"{flag} {text}: expected KEY=VALUE")
        pairs[key] = {"true": True, "false": False}.get(value.lower(), value)
    return pairs


def _settings(given: argparse.Namespace) -> FleetSettings:
    complete_options(_pairs("--set", given.set))  # raises what is wrong with them
    names = ("format", "detections", "odometry")
    dataset = {name: getattr(given, name) for name in names if getattr(given, name)}
    if given.candidates < 0:
        raise UsageError(f"--candidates {given.candidates}: must be at least 0")
    return FleetSettings(given.set, dataset, _pairs("--storage", given.storage), given.candidates)


def _client(given: argparse.Namespace) -> ContextManager[Client]:
    if given.scheduler:
        return remote_client(given.scheduler)
    if given.workers < 1:
        raise UsageError(f"--workers {given.workers}: must be at least 1")
    return local_client(given.workers, given.memory)


def _tell(report: FleetReport, out: str) -> None:
    for site in report.sites:
        print(
            f"site {site['name']}: {len(site['drives'])} drives, {site['landmarks']} landmarks, "
            f"{site['loops']} loops: {os.path.join(out, site['map'])}"
        )
    for drive in report.quarantined:
        print(f"left out: {drive['name']} ({drive['url']}): {drive['error']}", file=sys.stderr)
    for failed in report.failed_sites:
        print(f"not merged: {', '.join(failed['drives'])}: {failed['error']}", file=sys.stderr)
    for pair in report.failed_pairs:
        print(f"not compared: {pair['query']}, {pair['target']}: {pair['error']}", file=sys.stderr)
    print(
        f"{len(report.sites)} sites of {len(report.drives)} drives, {len(report.quarantined)} left "
        f"out: {os.path.join(out, 'sites.json')}, report.json"
    )


def _build(given: argparse.Namespace) -> int:
    settings = _settings(given)
    drives = find_drives(given.drives, settings.storage)
    with _client(given) as client:
        if has_dashboard():
            print(f"dashboard: {client.dashboard_link}", file=sys.stderr)
        else:
            print("no dashboard: pip install bokeh shows one", file=sys.stderr)
        report = build_fleet(drives, given.out, client, settings)
    _tell(report, given.out)
    return 0 if report.complete else _NOT_ALL


def main(arguments: Optional[List[str]] = None) -> int:
    """Runs the command line; returns the exit code."""
    given = _parser().parse_args(arguments)
    try:
        return _build(given)
    except Error as problem:
        print(f"error: {problem}", file=sys.stderr)
        return next(code for kind, code in _CODES.items() if isinstance(problem, kind))
    except KeyboardInterrupt:
        print("interrupted; the same command goes on", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
