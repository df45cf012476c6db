# SPDX-License-Identifier: BSD-3-Clause
"""Drives, tasks and outputs of fleets."""

import errno
import shutil
from pathlib import Path
from types import SimpleNamespace

import pytest

import sslcd
from fleet_case import client, folder  # noqa: F401

fsspec = pytest.importorskip("fsspec")

from sslcd.fleet import Drive, FleetSettings, build_fleet, find_drives  # noqa: E402
from sslcd.fleet.content import publish  # noqa: E402
from sslcd.fleet.drives import content_of, local_folder  # noqa: E402
from sslcd.fleet.report import Progress, StageStatistics  # noqa: E402
from sslcd.fleet.run_tasks import run_tasks  # noqa: E402
from sslcd.fleet.tasks import groups_of, measured  # noqa: E402


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


def test_calibration_beside_a_kitti_raw_drive(tmp_path):
    drive = tmp_path / "day" / "drive"
    (drive / "oxts" / "data").mkdir(parents=True)
    (drive / "oxts" / "data" / "0000000000.txt").write_text("49 8 116 0 0 0")
    linked = tmp_path / "linked"
    linked.symlink_to(drive)
    contents = [content_of(Drive("a", str(drive)), {})]
    for name in ("calib_cam_to_cam.txt", "calib_velo_to_cam.txt"):
        (drive.parent / name).write_text("R: 1")
        contents.append(content_of(Drive("a", str(drive)), {}))
        assert content_of(Drive("a", str(linked)), {}) == contents[-1]
    (drive.parent / name).write_text("R: 2")
    contents.append(content_of(Drive("a", str(drive)), {}))
    (drive.parent / "README.txt").write_text("of another drive")
    assert content_of(Drive("a", str(drive)), {}) == contents[-1]
    assert len(set(contents)) == 4
    memory = fsspec.filesystem("memory")
    memory.put(str(drive.parent), "/raw", recursive=True)
    with local_folder(Drive("a", "memory://raw/drive"), {}) as copy:
        beside = sorted(path.name for path in Path(copy).parent.iterdir())
    assert beside == ["a", "calib_cam_to_cam.txt", "calib_velo_to_cam.txt"]


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
