# SPDX-License-Identifier: BSD-3-Clause
import copy
import pickle
import threading

import numpy as np
import pytest

import sslcd
from conftest import arrays_of, mapper_for, translation


def test_streaming_is_the_offline_run_to_the_byte(drive, offline):
    mapper = mapper_for(drive)
    for frame in drive:
        mapper.add(frame)
    mapper.refine()
    assert mapper.trajectory.tum() == offline.trajectory.tum()
    assert np.array_equal(mapper.trajectory.poses, offline.trajectory.poses)
    assert [loop.id for loop in mapper.loops if loop.accepted] == [
        loop.id for loop in offline.loops if loop.accepted
    ]


def test_streaming_of_arrays_is_the_offline_run(drive, offline):
    mapper = mapper_for(drive)
    for frame in drive:
        mapper.add_frame(**arrays_of(frame))
    assert sum(loop.accepted for loop in mapper.loops) > 0
    mapper.refine()
    assert mapper.trajectory.tum() == offline.trajectory.tum()
    assert np.allclose(mapper.graph.measurements, offline.graph.measurements, atol=1e-9)
    assert [each.id for each in mapper.objects] == [each.id for each in offline.objects]


def test_changes_keep_a_copy_of_the_trajectory_and_the_loops_right(drive):
    mapper = mapper_for(drive)
    poses, loops = {}, {}

    def take(changes):
        poses.update(zip(changes.poses.frames, changes.poses.poses))
        for loop in changes.loops:
            loops[loop.id] = loop.decision
            if loop.early and not loop.accepted:
                del loops[loop.id]  # has ended

    for frame in drive:
        report = mapper.add(frame)
        take(report.changes)
        assert np.array_equal(report.T_world_cam, poses[frame.index])
        assert np.allclose(report.changes.T_world_odom @ frame.T_odom_cam, report.T_world_cam)
    mapper.refine()
    take(mapper.take_changes())
    trajectory = mapper.trajectory
    assert np.array_equal(trajectory.frames, np.arange(len(drive)))
    assert np.array_equal(trajectory.poses, np.stack([poses[i] for i in range(len(drive))]))
    assert loops == {loop.id: loop.decision for loop in mapper.loops}


def test_results_of_a_frame(mapper, pair):
    for i in range(4):
        report = mapper.add_frame(
            0.1 * i,
            translation(0, 0, i),
            **{**pair, "poses": pair["poses"] - translation(0, 0, i) + np.eye(4)},
        )
    assert report.filter.kept == 2 and report.filter.dropped == 0
    assert report.map.matched.tolist() == [each.id for each in mapper.objects]
    car, tree = mapper.objects
    assert (car.label, car.state, tree.label) == ("Car", "confirmed", "Tree")
    assert np.allclose(car.T_world_object[:3, 3], [1, 1, 10], atol=0.01)
    assert np.allclose(car.dims, [4, 1.8, 1.5])
    assert car.observations.tolist() == [[i, 0] for i in range(4)]
    assert mapper.current(car.id) == car.id and mapper.current(10**6) is None
    assert mapper.scale == 1 and mapper.improvement == sslcd.Improvement(0, 0)
    assert "0 loops accepted" in str(mapper.loop_search)
    assert mapper.graph.edges.tolist() == [[0, 1], [1, 2], [2, 3]]
    assert mapper.timing["data association"].count == 4
    assert "poses=<(4, 4, 4)>" in repr(mapper.trajectory)


def test_matched_is_in_the_order_of_the_detections_as_given(mapper, pair):
    pair["scores"] = np.array([0.1, 0.8])
    report = mapper.add_frame(0, np.eye(4), **pair)
    assert report.filter.low_score == 1
    assert report.map.matched.tolist() == [-1, mapper.objects[0].id]
    lost = mapper.add_frame(1, np.eye(4), step="lost", **pair)
    assert lost.map.matched.tolist() == [-1, -1]


def test_detections_that_are_not_finite_are_counted(mapper, pair):
    pair["poses"][0, 0, 3] = np.nan
    pair["dims"][1, 2] = np.inf
    assert mapper.add_frame(0, np.eye(4), **pair).filter.invalid == 2
    embeddings = np.array([[np.nan, 1], [1, 0]], np.float32)
    pair["poses"][0, 0, 3] = pair["dims"][1, 2] = 1
    assert mapper.add_frame(1, np.eye(4), **pair, embeddings=embeddings).filter.invalid == 1


def test_frames_without_detections(mapper):
    mapper.add_frame(0, np.eye(4))
    mapper.add_frame(1, np.eye(4), [], [], [], [])
    mapper.add_frame(
        2, np.eye(4), [], np.zeros((0, 4, 4)), np.zeros((0, 3)), [], np.zeros((0, 8)), None
    )
    assert len(mapper.trajectory) == 3 and mapper.objects == []
    empty = sslcd.Mapper()
    assert (
        not empty.refine().usable
        and len(empty.trajectory) == 0
        and empty.trajectory.poses.shape == (0, 4, 4)
    )
    assert empty.graph.information.shape == (0, 6, 6) and empty.take_changes().loops == []


@pytest.mark.parametrize(
    "T, stamp, message",
    [
        (np.full((4, 4), np.nan), 1.0, "not finite"),
        (np.eye(4), np.nan, "not finite"),
        (np.eye(4), 0.0, "is not after the one before it"),
        (np.diag([2.0, 2, 2, 1]), 1.0, "T_odom_cam is no rigid transform"),
        (np.diag([1.0, 1, -1, 1]), 1.0, "T_odom_cam is no rigid transform"),
        (np.ones((4, 4)), 1.0, "T_odom_cam is no rigid transform"),
        (translation(1e200, 0, 0), 1.0, "farther away"),
    ],
)
def test_a_bad_frame_raises_and_keeps_the_state(mapper, pair, T, stamp, message):
    mapper.add_frame(0.0, np.eye(4), **pair)
    with pytest.raises(sslcd.BadInputError, match=message):
        mapper.add_frame(stamp, T, **pair)
    report = mapper.add_frame(1.0, np.eye(4), **pair)
    assert report.map.born == 0 and mapper.trajectory.frames.tolist() == [0, 1]


def test_a_detection_that_is_turned_inside_out_names_its_row(mapper, pair):
    pair["poses"][1, :3, :3] *= 1.1
    with pytest.raises(sslcd.BadInputError, match=r"frame 0: poses\[1\] is no rigid transform"):
        mapper.add_frame(0, np.eye(4), **pair)


def test_frame_numbers(mapper):
    mapper.add_frame(0, np.eye(4), index=7)
    mapper.add_frame(1, np.eye(4))
    with pytest.raises(sslcd.BadInputError, match="its number is not above"):
        mapper.add_frame(2, np.eye(4), index=8)
    mapper.start_sequence()
    mapper.add_frame(-5, np.eye(4))
    assert mapper.trajectory.frames.tolist() == [7, 8, 9] and mapper.trajectory.stamps.tolist() == [
        0,
        1,
        -5,
    ]
    assert mapper.parts == [sslcd.MapPart(7, 0, 0), sslcd.MapPart(9, 1, 1)]


def test_steps(mapper):
    mapper.add_frame(0, np.eye(4), step=(0.1, 0.01))
    with pytest.raises(sslcd.BadInputError, match="standard deviation of its step"):
        mapper.add_frame(1, np.eye(4), step=(-1, 0))
    for step in ("loose", (1, 2, 3), 5):
        with pytest.raises(sslcd.UsageError, match="step is"):
            mapper.add_frame(1, np.eye(4), step=step)


def test_copies_go_their_own_way(drive, offline):
    mapper = mapper_for(drive)
    for frame in drive:
        mapper.add(frame)
    other = mapper.copy()
    other.refine()
    assert other.trajectory.tum() == offline.trajectory.tum() != mapper.trajectory.tum()
    for another in (copy.copy(other), copy.deepcopy(other)):
        another.add_frame(drive[-1].stamp + 1, drive[-1].T_odom_cam)
        assert len(another.trajectory) == len(other.trajectory) + 1
    assert len(copy.deepcopy(other.loops)) == len(pickle.loads(pickle.dumps(other.loops))) > 0


@pytest.mark.parametrize(
    "context, message",
    [
        ({"up": (0, 0, 0)}, "up direction is zero"),
        ({"up": (0, np.nan, 1)}, "up direction is zero or not finite"),
        ({"up": (0, 1)}, r"up has the shape \(2,\), expected \(3\)"),
        (
            {"labels": {"Tree": "round"}},
            "Tree has the symmetry 'round', must be one of none, pi, full",
        ),
        ({"labels": ["Tree"]}, "labels is"),
        ({"camera": sslcd.Camera(0, 500, 320, 240)}, "focal lengths"),
        ({"camera": {"fx": 500}}, "expected a sslcd.Camera"),
    ],
)
def test_a_bad_context_raises(context, message):
    with pytest.raises(ValueError, match=message) as caught:
        sslcd.Mapper(**context)
    assert isinstance(caught.value, sslcd.Error)


def test_a_map_of_classes_that_no_one_named(mapper, pair):
    pair["labels"] = ["Straßenlaterne", ""]
    assert mapper.add_frame(0, np.eye(4), **pair).filter.kept == 2
    assert {each.label for each in mapper.objects} == {"Straßenlaterne", ""}


def in_threads(*tasks):
    failures = []

    def attempt(task):
        try:
            task()
        except BaseException as failure:
            failures.append(failure)

    threads = [threading.Thread(target=attempt, args=[task]) for task in tasks]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []


def test_two_mappers_in_two_threads(drive, offline):
    mappers = [mapper_for(drive), mapper_for(drive)]

    def drive_on(mapper):
        for frame in drive:
            mapper.add(frame)
        mapper.refine()

    in_threads(*(lambda mapper=mapper: drive_on(mapper) for mapper in mappers))
    for mapper in mappers:
        assert mapper.trajectory.tum() == offline.trajectory.tum()


def test_threads_may_share_a_mapper(drive):
    mapper = mapper_for(drive)
    done = threading.Event()

    def add():
        for frame in drive:
            mapper.add(frame)
        done.set()

    def read():
        while not done.is_set():
            trajectory = mapper.trajectory
            assert len(trajectory.frames) == len(trajectory.poses) == len(trajectory.stamps)
            assert len(mapper.copy().trajectory) >= len(trajectory)
            mapper.loops, mapper.objects, mapper.graph

    in_threads(add, read, read)
    assert len(mapper.trajectory) == len(drive)


def test_long_calls_leave_the_interpreter_to_others(drive):
    mapper = mapper_for(drive)
    for frame in drive:
        mapper.add(frame)
    counted = 0
    refines = threading.Thread(target=mapper.refine)
    refines.start()
    while refines.is_alive():  # with the GIL held this loop would hardly turn
        counted += 1
    assert counted > 1000
