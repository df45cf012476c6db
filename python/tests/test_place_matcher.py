# SPDX-License-Identifier: BSD-3-Clause
"""A place matcher of the user's own."""

import gc
import threading

import numpy as np
import pytest

import sslcd
from conftest import mapper_for


def sslcd_itself(query):
    """sslcd's matching of one pair of maps, as a user's function."""
    result = sslcd.match(query.local, query.global_)
    if not result.hypotheses:
        return None
    best = result.hypotheses[0]
    return sslcd.PlaceAnswer(best.matches, score=result.score, accepted=result.accepted)


def test_a_matcher_by_objects_closes_loops(drive):
    asked = []

    def matcher(query):
        asked.append(query)
        return sslcd_itself(query)

    result = sslcd.run(drive, place_matcher=matcher)
    accepted = [loop for loop in result.loops if loop.accepted]
    assert accepted and accepted[0].reason == "the matcher is sure"
    query = asked[-1]
    assert query.frame > query.old_frame >= 0 and len(query.local) > 3 < len(query.global_)
    known = {each.id for each in result.objects}
    assert len(known & set(query.global_.ids.tolist())) > 3
    assert not sslcd.run(drive, place_matcher=lambda query: None).loops


def test_a_matcher_by_images_closes_loops(drive):
    def matcher(query):
        now, old = drive.groundtruth.poses[query.frame], drive.groundtruth.poses
        near = np.argmin(np.linalg.norm((old - now)[: query.old_frame + 1, :3, 3], axis=1))
        pose = np.linalg.inv(old[near]) @ now
        close = np.linalg.norm(pose[:3, 3]) < 5
        return sslcd.PlaceAnswer(match_frame=near, T_match_query=pose, score=9, accepted=close)

    options = {"refine.enabled": False, "loop.adjust_keyframes": 0}
    mapper = mapper_for(drive, options, place_matcher=matcher)
    for frame in drive:
        mapper.add(frame)
    accepted = [loop for loop in mapper.loops if loop.accepted]
    assert accepted and accepted[0].probability is None
    ate = sslcd.ate(mapper.trajectory, drive.groundtruth, "sim3").error.rmse
    odometry = np.stack([frame.T_odom_cam for frame in drive])
    assert ate < sslcd.ate(odometry, drive.groundtruth.poses, "sim3").error.rmse


def fails(query):
    raise ZeroDivisionError("in the matcher")


@pytest.mark.parametrize(
    "matcher, error, message",
    [
        (fails, ZeroDivisionError, "in the matcher"),
        (lambda query: 5, sslcd.UsageError, "returned 5, expected a sslcd.PlaceAnswer"),
        (lambda query: sslcd.PlaceAnswer([[0, 10**6]], accepted=True), sslcd.UsageError, None),
        (lambda query: sslcd.PlaceAnswer([1, 2]), sslcd.UsageError, "matches has the shape"),
        (lambda query: sslcd.PlaceAnswer(match_frame=10**6), sslcd.UsageError, None),
        (
            lambda query: sslcd.PlaceAnswer(T_match_query=np.ones((4, 4))),
            sslcd.BadInputError,
            "the place matcher's T_match_query is no rigid transform",
        ),
    ],
)
def test_a_matcher_that_fails(drive, matcher, error, message):
    with pytest.raises(error, match=message):
        sslcd.run(drive, place_matcher=matcher)


def test_a_matcher_that_fails_ends_the_thread_and_is_told(drive):
    with mapper_for(drive, kind=sslcd.AsyncMapper, place_matcher=fails) as mapper:
        for frame in drive:
            mapper.add(frame)
            mapper.wait()
        report = mapper.take_report()
        assert "ZeroDivisionError: in the matcher" in report.failure and report.dropped > 0
        with pytest.raises(sslcd.NoSolutionError, match="the mapper's thread has ended"):
            mapper.snapshot()
        assert not mapper.add(drive[0]) and len(report.changes.poses) > 0
        mapper.wait()


def test_a_matcher_on_another_thread(drive):
    with mapper_for(drive, kind=sslcd.AsyncMapper, place_matcher=sslcd_itself) as mapper:
        for frame in drive:
            mapper.add(frame)
            mapper.wait()
        mapper.refine()
        snapshot = mapper.snapshot()
    assert any(loop.accepted for loop in snapshot.loops)
    del mapper
    snapshot.refine()  # the copy holds the matcher


def test_a_matcher_that_calls_its_own_mapper(drive):
    mapper = mapper_for(drive, place_matcher=lambda query: mapper.loops)
    with pytest.raises(sslcd.UsageError, match="must not call its own mapper"):
        for frame in drive:
            mapper.add(frame)


def test_a_matcher_lives_as_long_as_its_mapper(drive):
    class Matcher:
        def __call__(self, query):
            return None

        def __del__(self):
            gone.set()

    gone = threading.Event()
    mapper = mapper_for(drive, place_matcher=Matcher())
    other = mapper.copy()
    del mapper
    gc.collect()
    assert not gone.is_set()
    for frame in drive:
        other.add(frame)
    del other
    gc.collect()
    assert gone.is_set()
    with pytest.raises(sslcd.UsageError, match="place_matcher is 5"):
        sslcd.Mapper(place_matcher=5)


def test_a_site_whose_name_is_no_utf8(tmp_path):
    places = np.random.default_rng(3).uniform(-40, 40, (12, 2))
    layout = sslcd.Layout(["Car"] * 12, np.column_stack([places, np.zeros(12)]))
    path = str(tmp_path / "index")
    sslcd._core.build_site_index(
        [b"caf\xe9"], [layout], path
    )  # as the program would, of a file name
    (found,) = sslcd.SiteIndex(path).find(layout, 1)
    assert found.name == "caf\\xe9"
