# SPDX-License-Identifier: BSD-3-Clause
"""Maps of many drives, on a cluster in this process."""

import json
import shutil
import warnings
from pathlib import Path

import numpy as np
import pytest

import sslcd
from conftest import DATA

pytest.importorskip("distributed")
fsspec = pytest.importorskip("fsspec")

from distributed import Client  # noqa: E402

from sslcd.fleet import FleetSettings, __main__, build_fleet, find_drives  # noqa: E402
from sslcd.fleet.components import Components  # noqa: E402
from sslcd.fleet.content import digest, publish_text  # noqa: E402


@pytest.fixture(scope="module")
def client():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with Client(
            processes=False, n_workers=1, threads_per_worker=2, dashboard_address=None
        ) as made:
            yield made


def cut(source, target, frames):
    """The first frames of a drive, as another drive."""
    target.mkdir(parents=True)
    for name in ("calib.txt", "sequence.yaml"):
        shutil.copy(source / name, target)
    for name in ("times.txt", "odometry.txt"):
        lines = (source / name).read_text().splitlines(True)
        (target / name).write_text("".join(lines[:frames]))
    rows = (source / "detections.txt").read_text().splitlines(True)
    rows = [row for row in rows if int(row.split()[0]) < frames]
    (target / "detections.txt").write_text("".join(rows))
    np.save(target / "embeddings.npy", np.load(source / "embeddings.npy")[: len(rows)])
    return target


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two drives of one site, one of another site."""
    folder = tmp_path_factory.mktemp("drives")
    cut(DATA / "sim_out_and_back", folder / "monday", 1000)
    cut(DATA / "sim_out_and_back", folder / "tuesday", 60)
    cut(DATA / "sim_rectangle", folder / "elsewhere", 60)
    return folder


@pytest.fixture(scope="module")
def built(folder, client, tmp_path_factory):
    """The outputs of a build of these, and its report."""
    out = tmp_path_factory.mktemp("sites")
    return out, build_fleet(find_drives([f"{folder}/*"], {}), out, client)


def files(out):
    """Path and inode of all outputs but the two reports, which are written again each time."""
    found = [path for path in Path(out).rglob("*") if path.is_file()]
    assert not [path for path in found if ".tmp-" in path.name or ".probe" in path.name]
    return {path.relative_to(out): path.stat().st_ino for path in found if path.parent != out}


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


def test_which_drives_are_given(folder, tmp_path):
    names = ["elsewhere", "monday", "tuesday"]
    assert [each.name for each in find_drives([f"{folder}/*"], {})] == names
    listed = tmp_path / "list.txt"
    listed.write_text(f"# drives\n{folder}/monday\n\nother={folder}/monday\n")
    assert [each.name for each in find_drives([f"@{listed}"], {})] == ["monday", "other"]
    (tmp_path / "monday").mkdir()
    for given, kind, message in (
        ([f"{folder}/monday", f"{tmp_path}/monday"], sslcd.UsageError, "two drives .* monday-2="),
        ([], sslcd.UsageError, "no drive is given"),
        ([f"{folder}/none"], sslcd.BadInputError, "no such folder"),
        ([f"{folder}/x*"], sslcd.UsageError, "no folder fits"),
        (["@/nowhere.txt"], sslcd.BadInputError, "list of drives"),
        (["nothing://bucket/drive"], sslcd.UsageError, "nothing"),
    ):
        with pytest.raises(kind, match=message):
            find_drives(given, {})


class Locked(fsspec.AbstractFileSystem):
    """A storage that wants credentials."""

    protocol = "locked"

    def info(self, path, **_):
        raise PermissionError("Access Denied")


def test_a_url_without_credentials():
    fsspec.register_implementation("locked", Locked, clobber=True)
    with pytest.raises(sslcd.BadInputError, match="Access Denied; .*credentials.* --storage"):
        find_drives(["locked://bucket/drive"], {})


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
    with pytest.raises(sslcd.OutputError, match="cannot be made"):
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
