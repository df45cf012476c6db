# SPDX-License-Identifier: BSD-3-Clause
"""Maps of many drives, on a cluster in this process."""

import errno
import json
import os
import shutil
from pathlib import Path

import pytest

import sslcd
from fleet_case import client, cut, folder  # noqa: F401

fsspec = pytest.importorskip("fsspec")

from sslcd.fleet import FleetSettings, __main__, build_fleet, find_drives  # noqa: E402
from sslcd.fleet.components import Components  # noqa: E402
from sslcd.fleet.content import digest  # noqa: E402


@pytest.fixture(scope="module")
def built(folder, client, tmp_path_factory):
    """The outputs of a build of these, and its report."""
    out = tmp_path_factory.mktemp("sites")
    return out, build_fleet(find_drives([f"{folder}/*"], {}), out, client)


def files(out):
    """Path and time of change of all outputs but the two reports, written again each time."""
    found = [path for path in Path(out).rglob("*") if path.is_file()]
    assert not [path for path in found if ".tmp-" in path.name or ".probe" in path.name]
    return {path.relative_to(out): path.stat().st_mtime_ns for path in found if path.parent != out}


def test_drives_of_a_site_are_merged(built):
    out, report = built
    assert report.complete and [each["name"] for each in report.sites] == ["elsewhere", "monday"]
    assert [each["drives"] for each in report.sites] == [["elsewhere"], ["monday", "tuesday"]]
    site = sslcd.Map(out / report.sites[1]["map"])
    assert site.verify() == [] and [each.name for each in site.sessions] == ["monday", "tuesday"]
    assert {part.joined_with for part in site.results.parts} == {0}
    told = json.loads((out / "sites.json").read_text())
    assert told["sites"][1]["map"] == report.sites[1]["map"]
    stages = {
        each["stage"]: each for each in json.loads((out / "report.json").read_text())["stages"]
    }
    assert stages["map"]["tasks"] == 3 and stages["map"]["cpu_s"] > 0
    assert stages["solve"]["bytes"] > 0


def test_a_rerun_does_only_what_is_missing(built, folder, client):
    out, report = built
    before, sites = files(out), (out / "sites.json").read_text()
    lost = out / report.sites[1]["map"]
    lost.with_suffix(".json").unlink()
    lost.unlink()
    again = build_fleet(find_drives([f"{folder}/*"], {}), out, client)
    after = files(out)
    made = {path for path in after if after[path] != before.get(path)}
    assert made == {lost.relative_to(out), lost.relative_to(out).with_suffix(".json")}
    assert (out / "sites.json").read_text() == sites
    assert [each.reused for each in again.stages] == [3, again.stages[1].tasks, 1]


def test_an_index_tells_which_drives_to_compare(built, folder, client):
    out, report = built
    ended = []
    found = build_fleet(
        find_drives([f"{folder}/*"], {}),
        out,
        client,
        FleetSettings(candidates=1),
        watch=lambda stage, record: ended.append((stage, record)),
    )
    assert [each.stage for each in found.stages] == ["map", "index", "rank", "verify", "solve"]
    ranked = {record["name"]: record["ranked"] for stage, record in ended if stage == "rank"}
    assert [ranked[name][0][0] for name in ("monday", "tuesday")] == ["tuesday", "monday"]
    assert found.sites == report.sites
    again = build_fleet(find_drives([f"{folder}/*"], {}), out, client, FleetSettings(candidates=1))
    assert all(each.reused == each.tasks for each in again.stages)


def test_bad_drives_are_left_out(built, folder, client, tmp_path):
    drives = tmp_path / "drives"
    (drives / "empty").mkdir(parents=True)
    cut(folder / "monday", drives / "broken", 1000)
    with open(drives / "broken" / "odometry.txt", "a") as file:
        file.write("1 2 three\n")
    shutil.copytree(folder / "tuesday", drives / "twin")
    given = [f"{folder}/*", f"{drives}/*"]
    report = build_fleet(find_drives(given, {}), built[0], client)
    errors = {each["name"]: each["error"] for each in report.quarantined}
    assert set(errors) == {"empty", "broken", "twin"} and not report.complete
    assert "no files" in errors["empty"]
    assert "odometry.txt:" in errors["broken"]
    assert "the same recording" in errors["twin"]
    assert [each["drives"] for each in report.sites] == [["elsewhere"], ["monday", "tuesday"]]
    with pytest.raises(sslcd.BadInputError, match="none of the 2 drives .*report.json"):
        build_fleet(
            find_drives([f"{drives}/empty", f"{drives}/broken"], {}), tmp_path / "o", client
        )
    assert json.loads((tmp_path / "o" / "report.json").read_text())["quarantined"]
    assert not (tmp_path / "o" / "sites.json").exists()


def test_drives_by_url(folder, client, tmp_path):
    memory = fsspec.filesystem("memory")
    memory.put(str(folder / "elsewhere"), "/bucket/drives/remote", recursive=True)
    memory.pipe("/bucket/drives/remote/image_2/000000.png", b"not needed")
    (drive,) = find_drives(["memory://bucket/drives/*"], {})
    assert drive.name == "remote" and drive.url.startswith("memory://")
    report = build_fleet([drive], tmp_path, client)
    assert report.complete
    site = sslcd.Map(tmp_path / report.sites[0]["map"])
    assert site.sessions[0].dataset == drive.url
    # the files of the drive are not read again
    assert build_fleet([drive], tmp_path, client).stages[0].reused == 1


def refused(capsys, code, message, *arguments):
    assert __main__.main(["build", *map(str, arguments)]) == code
    told = capsys.readouterr().err
    assert message in told and "Traceback" not in told


def test_mistakes_on_the_command_line(folder, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("sslcd.fleet.cluster.PATIENCE_S", 0.3)
    out, drive = tmp_path / "out", folder / "monday"
    away = "tcp://127.0.0.1:9"
    refused(capsys, 2, "no scheduler answers", drive, "--out", out, "--scheduler", away)
    refused(capsys, 3, "no such folder", folder / "none", "--out", out)
    refused(capsys, 4, "unknown key", drive, "--out", out, "--set", "windows=3")
    refused(capsys, 2, "expected KEY=VALUE", drive, "--out", out, "--set", "x")
    refused(capsys, 2, "--workers 0", drive, "--out", out, "--workers", 0)
    assert not out.exists()


def test_outputs_that_cannot_be_written(folder, client, tmp_path, monkeypatch):
    drives = find_drives([str(folder / "elsewhere")], {})
    (tmp_path / "file").write_text("")
    with pytest.raises(sslcd.OutputError, match="cannot be written: .*name a folder"):
        build_fleet(drives, tmp_path / "file" / "out", client)

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("sslcd.fleet.content.shutil.copyfileobj", full)
    with pytest.raises(sslcd.OutputError, match="No space left .*make room"):
        build_fleet(drives, tmp_path / "out", client)
    monkeypatch.undo()
    assert files(tmp_path / "out") == {}
    assert build_fleet(drives, tmp_path / "out", client).complete


def test_a_worker_of_another_version(folder, client, tmp_path, monkeypatch):
    monkeypatch.setattr(client, "run", lambda *_: {"tcp://1": "0.0.9"})
    with pytest.raises(sslcd.UsageError, match="another version .*0.0.9"):
        build_fleet(find_drives([str(folder / "monday")], {}), tmp_path, client)


def test_components():
    parts = Components("abcdef")
    parts.connect("a", "c")
    parts.connect("d", "e")
    parts.connect("e", "a")
    assert parts.connected("c", "d") and not parts.connected("a", "b")
    assert parts.groups() == [["a", "c", "d", "e"], ["b"], ["f"]]


def test_names_of_outputs():
    assert digest([1, "a"]) == digest([1, "a"]) != digest(["1", "a"])
    settings = FleetSettings()
    assert settings.key("drive", "a") != settings.key("drive", "b")
    assert settings.key("drive", "a") != FleetSettings(["mode=paper"]).key("drive", "a")


def test_pairs_that_fail_are_told(folder, client, tmp_path, monkeypatch, capsys):
    def lost(*_):
        raise OSError(errno.EIO, "Input/output error")

    drives = find_drives([f"{folder}/*day"], {})
    monkeypatch.setattr("sslcd.fleet.tasks._localise", lost)
    report = build_fleet(drives, tmp_path, client)
    assert [each["drives"] for each in report.sites] == [["monday"], ["tuesday"]]
    (pair,) = report.failed_pairs
    assert {pair["query"], pair["target"]} == {"monday", "tuesday"} and not report.complete
    assert (
        "Input/output"
        in json.loads((tmp_path / "report.json").read_text())["failed_pairs"][0]["error"]
    )
    __main__._tell(report, str(tmp_path))
    assert "not compared: tuesday, monday: " in capsys.readouterr().err
    monkeypatch.undo()
    again = build_fleet(drives, tmp_path, client)
    assert again.complete and [each["drives"] for each in again.sites] == [["monday", "tuesday"]]


@pytest.mark.parametrize("lost", ["report.json", "sites.json", ".probe"])
def test_reports_that_cannot_be_written(folder, built, client, monkeypatch, lost):
    def refuse(real):
        def call(path, *given, **more):
            if lost in os.path.basename(str(path)):
                raise OSError(errno.EROFS, "Read-only file system")
            return real(path, *given, **more)

        return call

    monkeypatch.setattr("builtins.open", refuse(open))
    with pytest.raises(sslcd.OutputError, match="cannot be written: .*Read-only.*name a folder"):
        build_fleet(find_drives([f"{folder}/*"], {}), built[0], client)
