# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

import sslcd

pytest.importorskip("rosbags", reason="no rosbags: pip install 'sslcd[bags]'")
from rosbags.rosbag2 import StoragePlugin  # noqa: E402

from bag_case import Recorder, record  # noqa: E402
from conftest import translation  # noqa: E402
from sslcd.bags import map_bag, typestore, write_bag  # noqa: E402

# the axes of a camera in those of a base: x forward, y left, z up
T_BASE_CAM = np.array([[0, 0, 1, 1.5], [-1, 0, 0, 0.2], [0, -1, 0, 1.1], [0, 0, 0, 1.0]])


def by_arrays(drive):
    """Without boxes and embeddings, which the messages lack."""
    mapper = sslcd.Mapper(labels=drive.labels, up=drive.up)
    for f in drive:
        mapper.add_frame(f.stamp, f.T_odom_cam, f.labels, f.poses, f.dims, f.scores, index=f.index)
    mapper.refine()
    return mapper


@pytest.mark.parametrize(
    "name, plugin",
    [
        ("drive.bag", None),
        ("drive_mcap", StoragePlugin.MCAP),
        ("drive_sqlite", StoragePlugin.SQLITE3),
    ],
)
def test_a_bag_is_the_drive(tmp_path, drive, name, plugin):
    classes = record(tmp_path / name, drive, plugin, T_BASE_CAM)
    options = {"labels": drive.labels, "up": drive.up, "class_names": classes}
    mapped = map_bag(tmp_path / name, "/odom", "/detections", **options)
    if plugin == StoragePlugin.MCAP:
        alone = map_bag(tmp_path / name / f"{name}.mcap", "/odom", "/detections", **options)
        assert np.array_equal(alone.path.poses, mapped.path.poses)
    expected = by_arrays(drive)
    assert mapped.drops == "" and (mapped.odom_frame, mapped.base_frame) == ("odom", "base_link")
    assert len(mapped.loops) == sum(each.accepted for each in expected.loops) > 3
    cameras = mapped.path.poses @ T_BASE_CAM
    assert np.abs(cameras - expected.trajectory.poses).max() < 1e-3
    assert np.abs(mapped.mapper.trajectory.poses - cameras).max() < 1e-9
    loop = mapped.loops[0]
    between = np.linalg.inv(mapped.path.poses[loop.match_frame])
    between = between @ mapped.path.poses[loop.query_frame]
    assert np.abs(between - loop.T_match_query)[:3, 3].max() < 0.5
    assert np.linalg.eigvalsh(loop.covariance).min() > 0
    assert loop.match_stamp == mapped.stamps[loop.match_frame]


def test_results_are_written_as_bags(tmp_path, drive):
    from rosbags.highlevel import AnyReader

    classes = record(tmp_path / "in.bag", drive)
    options = {"labels": drive.labels, "up": drive.up, "class_names": classes}
    mapped = map_bag(tmp_path / "in.bag", "/odom", "/detections", **options)
    for name in ("out.bag", "out"):
        write_bag(tmp_path / name, mapped)
        with AnyReader([tmp_path / name]) as reader:
            got = {c.topic: reader.deserialize(raw, c.msgtype) for c, _, raw in reader.messages()}
        path, markers = got["/sslcd/path"], got["/sslcd/markers"].markers
        assert path.header.frame_id == "map" and len(path.poses) == len(drive)
        position = path.poses[-1].pose.position
        assert np.allclose([position.x, position.y, position.z], mapped.path.positions[-1])
        stamp = path.poses[7].header.stamp
        assert stamp.sec * 10**9 + stamp.nanosec == mapped.stamps[7]
        lines = [each for each in markers if each.ns == "loops"]
        assert len(lines) == 1 and len(lines[0].points) == 2 * len(mapped.loops)
        confirmed = [each for each in mapped.mapper.objects if each.state == "confirmed"]
        assert len(markers) == len(confirmed) + 1
        with pytest.raises(sslcd.OutputError, match="exists"):
            write_bag(tmp_path / name, mapped)
    with pytest.raises(sslcd.UsageError):
        write_bag(tmp_path / "more", mapped, frame_id="")


def test_bags_without_the_topics_or_of_other_types(tmp_path, drive):
    record(tmp_path / "drive", drive)
    for arguments, message in (
        (("/odometry", "/detections"), "no topic /odometry; topics of .*Odometry: /odom; all"),
        (("/odom", "/boxes"), "no topic /boxes; topics of .*Detection3DArray: /detections"),
        (("/detections", "/odom"), "/detections has messages .*Detection3DArray, expected .*Odom"),
    ):
        with pytest.raises(sslcd.BadInputError, match=message):
            map_bag(tmp_path / "drive", *arguments)
    with pytest.raises(sslcd.BadInputError, match="nowhere"):
        map_bag(tmp_path / "nowhere", "/odom", "/detections")
    (tmp_path / "text.bag").write_text("no bag")
    with pytest.raises(sslcd.BadInputError, match="text.bag"):
        map_bag(tmp_path / "text.bag", "/odom", "/detections")
    with pytest.raises(sslcd.BadConfigError, match="unknown key"):
        map_bag(tmp_path / "drive", "/odom", "/detections", {"loops": 1})


def test_bags_from_which_no_frame_can_be_made(tmp_path, drive):
    record(tmp_path / "no_tf", drive, with_tf=False)
    with pytest.raises(sslcd.BadInputError, match="no frame could be made: .*/tf_static"):
        map_bag(tmp_path / "no_tf", "/odom", "/detections")
    with Recorder(tmp_path / "empty") as bag:
        bag.odometry(0, np.eye(4))
        bag.odometry(1, np.full((4, 4), np.nan))
        bag.detections(drive[0], [])
    with pytest.raises(sslcd.BadInputError, match="no frame could be made"):
        map_bag(tmp_path / "empty", "/odom", "/detections")


def test_stamps_that_go_back(tmp_path, drive):
    with Recorder(tmp_path / "two.bag") as bag:
        for begin in (100.0, 50.0):
            for i in range(20):
                bag.odometry(begin + 0.1 * i, translation(0, 0, 0.2 * i), child="camera")
                frame = sslcd.Frame(i, begin + 0.1 * i, np.eye(4))
                bag.detections(frame, [])
    with pytest.raises(sslcd.BadInputError, match="stamp 50.000 s is 51.900 s before .*new_seq"):
        map_bag(tmp_path / "two.bag", "/odom", "/detections")
    mapped = map_bag(tmp_path / "two.bag", "/odom", "/detections", new_sequences=True)
    assert len(mapped.path) == 40 and mapped.drops == ""
    assert mapped.stamps[0] == 100 * 10**9 and mapped.stamps[-1] >= 51.8e9


def test_definitions_of_vision_msgs():
    assert "vision_msgs/msg/Detection3DArray" in typestore().types
