# SPDX-License-Identifier: BSD-3-Clause
"""Maps of many drives, on a cluster in this process."""

import errno
import json
import os
import shutil
import warnings
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import sslcd
from conftest import DATA

pytest.importorskip("distributed")
fsspec = pytest.importorskip("fsspec")

from distributed import Client  # noqa: E402

from sslcd.fleet import Drive, FleetSettings, __main__, build_fleet, find_drives  # noqa: E402
from sslcd.fleet.components import Components  # noqa: E402
from sslcd.fleet.content import digest, publish, publish_text  # noqa: E402
from sslcd.fleet.drives import content_of, local_folder  # noqa: E402
from sslcd.fleet.report import Progress, StageStatistics  # noqa: E402
from sslcd.fleet.run_tasks import run_tasks  # noqa: E402
from sslcd.fleet.tasks import groups_of, measured  # noqa: E402


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


def test_two_builds_share_a_scheduler(client):
    stages = []
    for number in (1, 2):  # as of two processes, at the same time
        progress = Progress(StageStatistics("map"), 1)
        task = ({}, lambda number=number: {"error": "", "fatal": False, "number": number}, ())
        stages.append(run_tasks(client, [task], progress))
    keys = []
    submit = client.submit
    try:
        client.submit = lambda *given, **more: (keys.append(more["key"]), submit(*given, **more))[1]
        assert [record["number"] for stage in stages for record in stage] == [1, 2]
    finally:
        del client.submit
    # a number counted in each process would be the same in another one
    assert len(set(keys)) == 2 and all(len(key.rsplit("-", 1)[1]) == 32 for key in keys)


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


def test_a_map_without_its_log_is_not_published(tmp_path):
    (tmp_path / "map.db").write_text("pages")
    (tmp_path / "map.db-wal").write_text("")
    publish(str(tmp_path / "map.db"), str(tmp_path / "out" / "whole.db"))
    (tmp_path / "map.db-wal").write_text("sessions")
    with pytest.raises(sslcd.OutputError, match="log could not .*make room"):
        publish(str(tmp_path / "map.db"), str(tmp_path / "out" / "part.db"))
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["whole.db"]


def test_links_in_a_drive(folder, tmp_path):
    linked = tmp_path / "linked"
    linked.mkdir()
    shutil.copytree(folder / "monday", tmp_path / "elsewhere" / "inner")
    (linked / "inner").symlink_to(tmp_path / "elsewhere" / "inner")
    (linked / "circle").symlink_to(linked)
    (linked / "nothing.txt").symlink_to(tmp_path / "nothing")
    content = content_of(Drive("a", str(linked)), {})
    assert content == content_of(Drive("b", str(tmp_path / "elsewhere")), {})
    with open(tmp_path / "elsewhere" / "inner" / "odometry.txt", "a") as file:
        file.write("\n")
    assert content != content_of(Drive("a", str(linked)), {})


def test_files_outside_of_the_drives(folder, client, tmp_path, monkeypatch):
    drives = find_drives([f"{folder}/tuesday"], {})
    for name in ("/data/odometry.txt", "../odometry.txt"):
        with pytest.raises(sslcd.UsageError, match=f"odometry {name}: is not in the folder"):
            build_fleet(drives, tmp_path, client, FleetSettings(dataset={"odometry": name}))
    assert not list(tmp_path.iterdir())
    monkeypatch.chdir(folder / "monday")  # the loader would look here, too
    shutil.copy("odometry.txt", tmp_path / "other.txt")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(
        sslcd.BadInputError, match="has no other.txt; odometry must be in each drive"
    ):
        build_fleet(
            drives, tmp_path / "o", client, FleetSettings(dataset={"odometry": "other.txt"})
        )


def test_whose_fault_an_error_is():
    def told(problem):
        def work():
            raise problem

        return measured(work)

    memory = told(MemoryError())
    assert not memory["fatal"] and "raise --memory" in memory["error"]
    for code in (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES):
        assert told(OSError(code, "no"))["fatal"]
    assert told(sslcd.OutputError("no"))["fatal"]
    assert (
        not told(OSError(errno.EIO, "no"))["fatal"] and not told(sslcd.BadInputError("no"))["fatal"]
    )


def test_a_full_disk_is_not_a_lack_of_credentials(folder, monkeypatch):
    memory = fsspec.filesystem("memory")
    memory.put(str(folder / "elsewhere"), "/full/drive", recursive=True)

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(type(memory), "get_file", full)
    with pytest.raises(OSError, match="No space left") as raised:
        with local_folder(Drive("drive", "memory://full/drive"), {}):
            pass
    assert raised.value.errno == errno.ENOSPC


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


def test_stamps_from_the_names_of_images(folder, tmp_path):
    """Poses without stamps: those are the names of the images, also by URL."""
    drive = tmp_path / "drive"
    drive.mkdir()
    (drive / "odometry.txt").write_text("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n")
    shutil.copy(folder / "monday" / "calib.txt", drive)
    (drive / "detections.txt").write_text("")
    (drive / "image_2").mkdir()
    for name in ("10.500000", "11.000000"):
        (drive / "image_2" / f"{name}.png").write_text("")
    memory = fsspec.filesystem("memory")
    memory.put(str(drive), "/stamps/drive", recursive=True)
    content = content_of(Drive("a", str(drive)), {})
    for url in (str(drive), "memory://stamps/drive"):
        with local_folder(Drive("a", url), {}) as copy:
            assert [frame.stamp for frame in sslcd.load_dataset(copy)] == [10.5, 11]
    (drive / "image_2" / "11.000000.png").rename(drive / "image_2" / "12.000000.png")
    assert content != content_of(Drive("a", str(drive)), {})
    (drive / "times.txt").write_text("1\n2\n")
    content = content_of(Drive("a", str(drive)), {})
    shutil.rmtree(drive / "image_2")
    assert content == content_of(Drive("a", str(drive)), {})


def test_sessions_by_common_map():
    def groups(offsets, parts):
        sessions = [SimpleNamespace(name=n, frame_offset=o) for n, o in zip("abcd", offsets)]
        parts = [SimpleNamespace(first_frame=f, joined_with=j) for f, j in parts]
        return groups_of(sessions, parts)

    assert groups([0, 10], [(0, 0), (10, 0)]) == [["a", "b"]]
    assert groups([0, 10], [(0, 0), (10, 1)]) == [["a"], ["b"]]
    # odometry was lost in b, whose second part has been joined
    assert groups([0, 10], [(0, 0), (10, 1), (15, 0)]) == [["a", "b"]]
    # the number of the first frame of b is not 0
    assert groups([0, 10], [(0, 0), (13, 0)]) == [["a", "b"]]
    # c is in both maps; d has no frame
    assert groups([0, 10, 20, 30], [(0, 0), (10, 1), (20, 0), (25, 1)]) == [["a", "b", "c"], ["d"]]
    assert groups([0], []) == [["a"]] and groups([], []) == []
