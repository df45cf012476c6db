# SPDX-License-Identifier: BSD-3-Clause
"""Maps in files."""

import pickle
import shutil

import numpy as np
import pytest

import sslcd
from conftest import context_of, translation


@pytest.fixture(scope="module")
def made(drive, tmp_path_factory):
    """A map of one session."""
    site = sslcd.Map(tmp_path_factory.mktemp("map") / "site.db")
    site.add(drive, "first")
    return site


@pytest.fixture
def site(made, tmp_path):
    """A copy of it, to be changed."""
    return sslcd.Map(shutil.copy(made.path, tmp_path / "site.db"))


@pytest.fixture(scope="module")
def other(made, drive, tmp_path_factory):
    """A map of a part of the drive."""
    map_ = sslcd.Map(tmp_path_factory.mktemp("map") / "other.db")
    with map_.start_session("second", **context_of(drive)) as session:
        for frame in list(drive)[:25]:
            session.add(frame)
    return map_


@pytest.fixture(scope="module")
def merged(made, other, tmp_path_factory):
    """The map of both, and what was told while they were merged."""
    map_ = sslcd.Map(tmp_path_factory.mktemp("map") / "merged.db")
    steps = []
    report = made.merge([other.path], out=map_.path, progress=lambda *now: steps.append(now))
    return map_, report, steps


def test_a_session_is_a_plain_run(made, drive, offline):
    results = made.results
    assert results.trajectories["first"].tum() == offline.trajectory.tum()
    assert results.odometry["first"].tum() == offline.odometry.tum()
    assert [each.id for each in results.objects] == [each.id for each in offline.objects]
    assert results.graph.g2o() == offline.graph.g2o()
    assert len(results.loops) == len(offline.loops) and results.scale == offline.scale


def test_a_map_tells_what_it_is_about(made, drive):
    info = made.info
    np.testing.assert_array_equal(info.up, drive.up)
    assert set(drive.labels.items()) <= set(info.labels.items())
    assert info.camera == drive.camera
    (session,) = made.sessions
    assert session.name == "first" and session.ended and session.frames == len(drive)
    assert session.dataset == drive.path and len(session.checksum) == 64
    assert "loop:" in info.config
    assert made.verify() == [] and made.exists
    assert pickle.loads(pickle.dumps(made)).info.created == info.created


def test_the_frames_are_kept(made, drive):
    frames = made.frames("first")
    assert [each.index for each in frames] == [each.index for each in drive]
    np.testing.assert_array_equal(frames[3].poses, drive[3].poses)
    mapper = sslcd.Mapper(**context_of(drive))
    for frame in frames:
        mapper.add(frame)
    mapper.refine()
    assert mapper.trajectory.tum() == made.results.trajectories["first"].tum()
    with pytest.raises(sslcd.UsageError, match="no session 'x'"):
        made.frames("x")


def test_a_session_that_is_interrupted_goes_on(made, drive, tmp_path):
    map_ = sslcd.Map(tmp_path / "site.db")
    assert not map_.exists
    with pytest.raises(KeyError):
        with map_.start_session("first", **context_of(drive)) as session:
            for frame in list(drive)[:15]:
                session.add(frame)
            raise KeyError
    assert [(each.frames, each.ended) for each in map_.sessions] == [(15, False)]
    with pytest.raises(sslcd.UsageError, match="has not been ended"):
        map_.start_session("other", **context_of(drive))
    with map_.resume_session(**context_of(drive)) as session:
        assert session.info.name == "first" and session.stored_frames == 15
        for frame in drive:
            if not session.is_stored(frame):
                session.add(frame)
        assert len(session.mapper.trajectory) == len(drive)
    with pytest.raises(sslcd.UsageError, match="ended or closed"):
        session.add(drive[0])
    assert map_.results.trajectories["first"].tum() == made.results.trajectories["first"].tum()
    with pytest.raises(sslcd.UsageError, match="no session to go on with"):
        map_.resume_session(**context_of(drive))


def test_what_does_not_belong_to_a_map_is_refused(site, drive):
    given = context_of(drive)
    with pytest.raises(sslcd.UsageError, match="'first' already"):
        site.start_session("first", **given)
    with pytest.raises(sslcd.BadInputError, match="another site"):
        site.start_session("x", **{**given, "up": (0, 0, 1)})
    with pytest.raises(sslcd.UsageError, match="other options"):
        site.start_session("x", options={"window": {"keyframes": 5}}, **given)
    with pytest.raises(sslcd.BadConfigError, match="window.frames"):
        site.start_session("x", options={"window": {"frames": 5}}, **given)
    assert len(site.sessions) == 1


def test_files_that_are_no_map(tmp_path, drive):
    missing, text = tmp_path / "none.db", tmp_path / "text.db"
    text.write_text("no database, but a text\n" * 100)
    for path, message in ((missing, "no such map"), (text, "not an SQLite file")):
        map_ = sslcd.Map(path)
        for call in (
            lambda: map_.info,
            lambda: map_.results,
            map_.verify,
            lambda: map_.history,
            map_.diff,
            lambda: map_.frames("x"),
            lambda: map_.export(tmp_path / "out"),
            lambda: sslcd.Localiser(map_),
        ):
            with pytest.raises(sslcd.BadInputError, match=message):
                call()
    assert not sslcd.Map(missing).exists and not missing.exists()


def test_a_drive_is_localised(made, drive):
    answers = made.localise(list(drive)[:25], camera=drive.camera)
    assert answers[-1].frame == 24
    found = [each for each in answers if each.accepted]
    assert found, answers
    truth = dict(
        zip(*(getattr(made.results.trajectories["first"], n) for n in ("frames", "poses")))
    )
    for each in found:
        assert np.linalg.norm(each.T_map_cam[:3, 3] - truth[each.frame][:3, 3]) < 0.5
        assert each.covariance.shape == (6, 6) and each.probability > 0.9
        assert len(each.pairs) >= 4
    assert len(made.localise(drive, first=True)) <= len(answers)
    localiser = sslcd.Localiser(made.path)
    with pytest.raises(sslcd.UsageError):
        localiser.attempt()
    localiser.add(drive[0])
    assert localiser.attempt().T_map_cam is None
    with pytest.raises(sslcd.BadInputError, match="another site"):
        sslcd.Localiser(made, labels=drive.labels, up=(0, 0, 1))
    with pytest.raises(sslcd.UsageError, match="without up"):
        sslcd.Localiser(made, labels=drive.labels)


def test_merge(merged, site, other):
    map_, report, steps = merged
    assert steps[-1] == (25, 25) and map_.verify() == []
    assert [(each.old_name, each.name, each.frames) for each in report.added] == [
        ("second", "second", 25)
    ]
    assert [each.name for each in map_.sessions] == ["first", "second"]
    before = open(site.path, "rb").read()
    with pytest.raises(KeyError):
        site.merge(other, progress=lambda done, total: {}[done])
    assert open(site.path, "rb").read() == before
    with pytest.raises(sslcd.UsageError, match="the same drive"):
        map_.merge(other, rename=True)
    site.compact()


def test_what_has_changed(made, merged):
    with pytest.raises(sslcd.UsageError, match="one session"):
        made.diff()
    map_ = merged[0]
    history = map_.history
    assert all(len(place.seen) == 2 for place in history.places)
    outcome = history.between(0, 0, 1)
    total = outcome.stayed + outcome.departed + outcome.replaced + outcome.arrived + outcome.empty
    assert total == pytest.approx(1)
    assert set(history.rates) <= set(map_.info.labels)
    with pytest.raises(sslcd.UsageError, match="the earlier session comes first"):
        history.between(0, 1, 1)
    diff = map_.diff("first", "second")
    assert (diff.before, diff.after) == ("first", "second")
    assert diff.stayed > 0
    for change in diff.changes:
        outcome = history.between(change.place, 0, 1)
        gone, come = outcome.departed + outcome.replaced, outcome.arrived + outcome.replaced
        told = {"departed": gone, "arrived": come, "replaced": min(gone, come)}
        assert change.probability == pytest.approx(told[change.kind]) and change.probability >= 0.5


def test_export(made, tmp_path, offline):
    paths = made.export(tmp_path / "out")
    assert (tmp_path / "out" / "graph.g2o").read_text() == offline.graph.g2o()
    assert all(path.startswith(str(tmp_path)) for path in paths)


def test_parquet(made, tmp_path):
    pytest.importorskip("pyarrow")
    from pyarrow import parquet

    from sslcd.parquet import write_parquet

    results = made.results
    tables = {p.rsplit("/")[-1]: parquet.read_table(p) for p in write_parquet(made, tmp_path / "o")}
    poses, landmarks = tables["poses.parquet"], tables["landmarks.parquet"]
    trajectory = results.trajectories["first"]
    np.testing.assert_allclose(poses["x"].to_numpy(), trajectory.positions[:, 0], atol=1e-6)
    assert landmarks.num_rows == len(results.objects)
    assert tables["loops.parquet"].num_rows == len(results.loops)
    assert tables["sightings.parquet"].num_rows == sum(landmarks["sightings"].to_pylist())
    assert tables["sessions.parquet"]["name"].to_pylist() == ["first"]


def test_a_map_of_arrays(tmp_path):
    """Twelve trees, passed twice, without any dataset."""
    site = sslcd.Map(tmp_path / "trees.db")
    for name in ("one", "two"):
        with site.start_session(name, labels={"Tree": "full"}) as session:
            for i in range(12):
                trees = [translation(x, 0, 8 + z) for x, z in ((-4, i % 3), (4, 2 * i % 5))]
                session.add_frame(i, translation(0, 0, i), ["Tree"] * 2, trees, [[1, 1, 5]] * 2)
    assert [each.frame_offset for each in site.sessions] == [0, 12]
    assert len(site.results.trajectories["two"]) == 12
