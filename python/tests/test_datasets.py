# SPDX-License-Identifier: BSD-3-Clause
import json
import os
import subprocess

import numpy as np
import pytest

import sslcd
from conftest import DATA


def test_a_dataset_is_a_sequence_of_frames(drive):
    assert (drive.format, drive.name, len(list(drive))) == (
        "sequence",
        "sim_out_and_back",
        len(drive),
    )
    assert (
        drive.labels["Tree"] == "full"
        and drive.up.tolist() == [0, -1, 0]
        and drive.camera.width == 1280
    )
    assert drive.warnings == [] and len(drive.groundtruth) == len(drive)
    frame = drive[-1]
    assert frame.index == len(drive) - 1 and frame.poses.shape == (len(frame), 4, 4)
    assert np.allclose(np.linalg.norm(frame.embeddings, axis=1), 1, atol=1e-5)
    assert frame.boxes.shape == (len(frame), 4) and frame.colours is None and frame.step is None
    with pytest.raises(IndexError):
        drive[len(drive)]


def test_parts_of_a_dataset():
    few = sslcd.load_dataset(
        str(DATA / "sim_out_and_back"), max_frames=10, odometry="groundtruth.txt"
    )
    assert len(few) == 10 and np.allclose(few[5].T_odom_cam, few.groundtruth.poses[5])
    with pytest.raises(sslcd.BadInputError, match="no such folder"):
        sslcd.load_dataset("nowhere")
    with pytest.raises(sslcd.UsageError, match="score is 'percent'"):
        sslcd.load_dataset(DATA / "sim_out_and_back", score="percent")
    with pytest.raises(sslcd.Error, match="format"):
        sslcd.load_dataset(DATA / "sim_out_and_back", format="carla")


def test_images_without_detections_say_what_makes_them(tmp_path):
    for name in ("times.txt", "odometry.txt", "calib.txt"):
        (tmp_path / name).write_bytes((DATA / "sim_out_and_back" / name).read_bytes())
    with pytest.raises(sslcd.Error, match="detections"):
        sslcd.load_dataset(tmp_path)


def test_a_run_is_that_of_the_program(tmp_path, offline, sslcd_run):
    there, here = tmp_path / "there", tmp_path / "here"
    subprocess.run(
        [sslcd_run, "run", DATA / "sim_out_and_back", "--out", there, "--quiet"], check=True
    )
    offline.write(here)
    assert sorted(os.listdir(there)) == sorted(os.listdir(here))
    for name in (
        "trajectory_tum.txt",
        "trajectory_kitti.txt",
        "odometry_tum.txt",
        "map.json",
        "map.ply",
        "graph.g2o",
        "loops.csv",
    ):
        assert (there / name).read_text() == (here / name).read_text(), name
    assert offline.trajectory.tum() == (there / "trajectory_tum.txt").read_text()
    assert offline.trajectory.kitti() == (there / "trajectory_kitti.txt").read_text()


def test_the_run_helps(drive, offline):
    after = sslcd.ate(offline.trajectory, drive.groundtruth, "sim3").error
    before = sslcd.ate(offline.odometry, drive.groundtruth, "sim3").error
    assert after.count == len(drive) and after.rmse < 0.5 * before.rmse
    assert offline.trajectory.frames.tolist() == list(range(len(drive)))
    assert offline.refinement.usable and offline.improvement.horizontal > 0.99
    assert 0.9 < offline.scale < 1.1 and offline.filter.kept > 0 and offline.noise_scale.radial > 0
    assert offline.images_failed == 0 and "loop detection" in offline.timing
    assert len(offline.graph.edges) == len(drive) - 1 + offline.graph.loops.sum()


def test_options_and_progress(drive):
    seen = []
    result = sslcd.run(
        drive, {"loop": {"enabled": False}}, progress=lambda done, total: seen.append((done, total))
    )
    assert result.loops == [] and seen == [(i + 1, len(drive)) for i in range(len(drive))]

    def fails(done, total):
        raise ZeroDivisionError(done)

    with pytest.raises(ZeroDivisionError):
        sslcd.run(drive, progress=fails)
    with pytest.raises(sslcd.BadConfigError):
        sslcd.run(drive, {"loops": {}})


def test_ctrl_c_ends_a_run(drive, ctrl_c):
    def interrupts(done, total):
        import _thread

        _thread.interrupt_main()

    with pytest.raises(KeyboardInterrupt):
        sslcd.run(drive, progress=interrupts)


def test_colours_from_images(tmp_path):
    source = DATA / "sim_out_and_back"
    for path in source.iterdir():
        if path.name != "embeddings.npy":
            (tmp_path / path.name).write_bytes(path.read_bytes())
    (tmp_path / "image_2").mkdir()
    (tmp_path / "image_2" / "000000.png").write_bytes(b"not read by sslcd")
    dataset = sslcd.load_dataset(tmp_path, max_frames=20)
    assert dataset[0].image_left.endswith("000000.png")
    asked = []

    def load(path):
        asked.append(path)
        return np.full((720, 1280, 3), 128, np.uint8) if len(asked) < 3 else None

    result = sslcd.run(dataset, load_image=load)
    assert len(asked) >= 1 and result.images_failed == max(0, len(asked) - 2)
    for bad in (np.zeros((720, 1280)), np.zeros((720, 1280, 3)), "pixels"):
        with pytest.raises(sslcd.UsageError, match="uint8"):
            sslcd.run(dataset, load_image=lambda path: bad)


def test_a_folder_that_cannot_be_written(offline, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(sslcd.OutputError):
        offline.write(tmp_path / "file" / "run")


def test_the_written_folder(offline, tmp_path):
    paths = offline.write(tmp_path / "run")
    assert sorted(map(os.path.basename, paths)) == sorted(os.listdir(tmp_path / "run"))
    assert json.loads((tmp_path / "run" / "metrics.json").read_text()) == {}
    objects = json.loads((tmp_path / "run" / "map.json").read_text())["objects"]
    assert [each["id"] for each in objects] == [each.id for each in offline.objects]
