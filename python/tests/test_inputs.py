# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of all kinds as they come from hosts."""

import dataclasses
import pickle

import numpy as np
import pytest

import sslcd
from conftest import DATA


def test_the_layout_of_arrays_does_not_matter(drive):
    frame = next(frame for frame in drive if len(frame) > 2)
    mapper = sslcd.Mapper()
    kinds = {
        "as it is": lambda array: array,
        "Fortran": np.asfortranarray,
        "every second row of twice as many": lambda array: np.repeat(array, 2, axis=0)[::2],
        "backwards twice": lambda array: array[::-1].copy()[::-1],
        "list": lambda array: array.tolist(),
        "big-endian": lambda array: array.astype(array.dtype.newbyteorder(">")),
    }
    objects = []
    for kind, change in kinds.items():
        mapper = sslcd.Mapper()
        mapper.add_frame(
            0,
            change(frame.T_odom_cam),
            list(frame.labels),
            change(frame.poses),
            change(frame.dims),
            change(frame.scores),
            change(frame.embeddings),
            boxes=change(frame.boxes),
        )
        objects.append([each.T_world_object for each in mapper.objects])
        assert len(objects[-1]) > 2 and np.array_equal(objects[-1], objects[0]), kind


def test_integers_and_float32_are_numbers(mapper):
    mapper.add_frame(
        0,
        np.eye(4, dtype=np.int64),
        np.array(["Car"]),
        np.eye(4, dtype=np.float32)[None],
        [[4, 2, 1]],
        [1],
    )
    assert mapper.objects[0].dims.tolist() == [4, 2, 1]


@pytest.mark.parametrize(
    "change, message",
    [
        ({"poses": np.eye(4)}, r"poses has the shape \(4, 4\), expected \(N, 4, 4\)"),
        ({"poses": np.zeros((2, 3, 4))}, r"poses has the shape \(2, 3, 4\), expected \(N, 4, 4\)"),
        ({"poses": np.zeros((3, 4, 4))}, "poses has 3 rows, but there are 2 detections"),
        ({"poses": []}, r"poses has the shape \(0,\), expected"),
        ({"poses": None}, "poses"),
        ({"poses": "many"}, "poses cannot be read as numbers"),
        (
            {"poses": np.zeros((2, 4, 4), complex)},
            "poses cannot be read as numbers: complex numbers",
        ),
        ({"poses": [[1, 2], [3]]}, "poses"),
        ({"dims": np.ones((3, 2))}, r"dims has the shape \(3, 2\), expected \(N, 3\)"),
        ({"dims": np.ones(3)}, "dims has the shape"),
        ({"scores": 0.5}, r"scores has the shape \(\), expected \(N\)"),
        ({"scores": [0.5]}, "scores has 1 rows, but there are 2 detections"),
        ({"scores": np.ones((2, 1))}, "scores has the shape"),
        ({"embeddings": np.ones((1, 8))}, "embeddings has 1 rows"),
        ({"embeddings": np.ones(2)}, r"embeddings has the shape \(2,\), expected \(N, N\)"),
        ({"colours": np.ones((3, 8))}, "colours has 3 rows"),
        ({"boxes": np.ones((2, 5))}, "boxes has the shape"),
        ({"labels": "Ca"}, "labels is the text 'Ca'"),
        ({"labels": [3, 4]}, "labels has 3, expected texts"),
        ({"labels": 2}, "labels is 2"),
        ({"T_odom_cam": np.eye(3)}, r"T_odom_cam has the shape \(3, 3\), expected \(4, 4\)"),
        ({"stamp": [1, 2]}, r"stamp has the shape \(2,\), expected \(\)"),
        ({"stamp": "now"}, "stamp cannot be read as numbers"),
        ({"stamp": None}, "stamp"),
        ({"index": 1.5}, "index is 1.5"),
        ({"index": True}, "index is True"),
    ],
)
def test_wrong_arrays_raise_and_keep_the_state(mapper, pair, change, message):
    with pytest.raises(sslcd.UsageError, match=message):
        mapper.add_frame(**{"stamp": 0, "T_odom_cam": np.eye(4), **pair, **change})
    assert len(mapper.trajectory) == 0
    mapper.add_frame(0, np.eye(4), **pair)
    assert mapper.trajectory.frames.tolist() == [0]


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda mapper: mapper.add(None), "frame is None, expected a sslcd.Frame"),
        (lambda mapper: sslcd.AsyncMapper().add("x"), "frame is 'x'"),
        (lambda mapper: sslcd.AsyncMapper(most_waiting="many"), "most_waiting"),
        (lambda mapper: sslcd.run("folder"), "dataset is 'folder', expected a sslcd.Dataset"),
        (lambda mapper: sslcd.match(None, None), "local is None, expected a sslcd.Layout"),
        (lambda mapper: sslcd.solve_graph([]), r"graph is \[\], expected a sslcd.PoseGraph"),
        (lambda mapper: sslcd.Camera("wide", 1, 1, 1), "Camera.fx"),
        (lambda mapper: sslcd.Camera(1, 1, 1, 1, 640.5), "Camera.width"),
        (lambda mapper: sslcd.Mapper(labels={"Car": 2}), "labels has 'Car': 2"),
        (lambda mapper: sslcd.load_dataset(DATA, max_frames=-1), "max_frames is -1"),
    ],
)
def test_things_of_other_kinds_raise(mapper, call, message):
    with pytest.raises(sslcd.UsageError, match=message):
        call(mapper)


def test_a_path_that_is_no_text():
    with pytest.raises(sslcd.BadInputError, match=r"\\xff"):
        sslcd.load_dataset(b"\xff")


def test_an_index_beyond_32_bits_is_refused(mapper):
    with pytest.raises(sslcd.UsageError, match="index"):
        mapper.add_frame(0, np.eye(4), index=2**40)
    for ids in ([0.5], [2**40]):
        with pytest.raises(sslcd.UsageError, match="ids has numbers that are not whole"):
            sslcd.PoseGraph(ids, np.eye(4)[None], [True], [], [], [], [])


def test_embeddings_are_normalised_and_a_row_of_zeros_is_none(drive):
    plain, scaled = sslcd.Mapper(labels=drive.labels), sslcd.Mapper(labels=drive.labels)
    for frame in drive:
        plain.add(frame)
        scaled.add(
            dataclasses.replace(
                frame, embeddings=None if frame.embeddings is None else frame.embeddings * 100
            )
        )
    assert len(plain.objects) > 10
    assert [each.id for each in plain.objects] == [each.id for each in scaled.objects]
    zeros = sslcd.Mapper()
    report = zeros.add_frame(
        0, np.eye(4), ["Car"], np.eye(4)[None], [[4, 2, 1]], [1], np.zeros((1, 8))
    )
    assert report.filter.kept == 1


def test_frames_of_a_dataset_cannot_be_changed_by_accident(drive):
    frame = drive[5]
    with pytest.raises(ValueError):
        frame.poses[0, 0, 3] += 1
    with pytest.raises(dataclasses.FrozenInstanceError):
        frame.stamp = 5
    moved = dataclasses.replace(frame, T_odom_cam=frame.T_odom_cam @ np.diag([1, -1, -1, 1]))
    mapper = sslcd.Mapper()
    assert np.allclose(mapper.add(moved).T_world_cam[:3, :3], moved.T_odom_cam[:3, :3], atol=0.1)
    again = pickle.loads(pickle.dumps(frame))
    assert np.array_equal(again.poses, frame.poses) and again.labels == frame.labels


def test_arrays_of_the_host_are_not_touched(mapper, pair):
    before = {name: np.array(value) for name, value in pair.items()}
    mapper.add_frame(0, np.eye(4), **pair)
    for name, value in pair.items():
        assert np.array_equal(value, before[name])
    pair["poses"][0, 0, 3] = 50  # still writeable, and not seen by the mapper
    assert mapper.objects[0].T_world_object[0, 3] != 50


def test_cuboids_of_kitti_are_those_of_the_reader(drive):
    rows = [line.split() for line in (DATA / "sim_out_and_back" / "detections.txt").open()]
    for frame in list(drive)[::10]:
        mine = np.array([row[10:17] for row in rows if int(row[0]) == frame.index], float)
        mine = mine.reshape(-1, 7)
        poses, dims = sslcd.kitti_cuboids(mine[:, 3:6], mine[:, 6], mine[:, :3])
        assert np.allclose(poses, frame.poses, atol=1e-12) and np.allclose(dims, frame.dims)
    assert sslcd.kitti_cuboids([], [], [])[0].shape == (0, 4, 4)
    with pytest.raises(sslcd.UsageError, match="rotations_y has 2 rows"):
        sslcd.kitti_cuboids([[0, 0, 1]], [0, 0], [[1, 1, 1]])
