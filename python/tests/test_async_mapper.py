# SPDX-License-Identifier: BSD-3-Clause
import _thread
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import sslcd
from conftest import DATA, mapper_for


def test_it_is_a_mapper(drive, offline):
    with mapper_for(
        drive, kind=sslcd.AsyncMapper, most_waiting=10**6, refine_every_m=0
    ) as mapper:
        assert all(mapper.add(frame) for frame in drive)
        mapper.refine()
        snapshot = mapper.snapshot()
        mapper.wait()
        report = mapper.take_report()
    assert snapshot.trajectory.tum() == offline.trajectory.tum()
    assert snapshot.trajectory.frames.tolist() == list(range(len(drive)))
    assert (report.frames, report.dropped, report.refused, report.failure) == (len(drive), 0, 0, "")
    assert np.array_equal(report.changes.poses.poses, offline.trajectory.poses)
    snapshot.add_frame(
        drive[-1].stamp + 1, drive[-1].T_odom_cam
    )  # goes on where the copy was taken
    assert snapshot.trajectory.frames[-1] == len(drive)


def test_a_full_queue_drops_and_counts(drive):
    with mapper_for(drive, kind=sslcd.AsyncMapper, most_waiting=1) as mapper:
        taken = [mapper.add(frame) for frame in drive]
        mapper.wait()
        report = mapper.take_report()
        assert report.frames == sum(taken) and report.dropped == len(taken) - sum(taken) > 0
        assert mapper.take_report().frames == 0


def test_a_bad_frame_is_refused_and_the_thread_goes_on():
    with sslcd.AsyncMapper() as mapper:
        mapper.add_frame(0, np.eye(4))
        mapper.add_frame(0, np.eye(4))
        mapper.add_frame(1, np.full((4, 4), np.nan))
        mapper.start_sequence()
        mapper.add_frame(-9, np.eye(4))
        with pytest.raises(sslcd.UsageError):
            mapper.add_frame(2, np.eye(3))
        with pytest.raises(sslcd.BadInputError, match="no rigid transform"):
            mapper.add_frame(2, np.ones((4, 4)))
        mapper.wait()
        report = mapper.take_report()
    assert (report.frames, report.refused, report.failure) == (2, 2, "")
    assert "not finite" in report.refusal


def test_calls_after_close():
    mapper = sslcd.AsyncMapper()
    mapper.close()
    mapper.close()
    assert mapper.closed
    for call in (
        mapper.wait,
        mapper.refine,
        mapper.take_report,
        mapper.snapshot,
        mapper.start_sequence,
        lambda: mapper.add_frame(0, np.eye(4)),
    ):
        with pytest.raises(sslcd.UsageError, match="closed"):
            call()


def test_close_while_others_wait(drive):
    mapper = mapper_for(drive, kind=sslcd.AsyncMapper, most_waiting=10**6)
    for frame in drive:
        mapper.add(frame)
    waits = threading.Thread(target=mapper.wait)
    waits.start()
    mapper.close()
    waits.join(60)
    assert not waits.is_alive()


def test_bad_queues_and_options():
    with pytest.raises(sslcd.BadConfigError, match="unknown key"):
        sslcd.AsyncMapper({"loops": 1})
    for most in (0, -1):
        with pytest.raises(sslcd.UsageError, match="most_waiting"):
            sslcd.AsyncMapper(most_waiting=most)


def test_ctrl_c_interrupts_a_wait(drive, ctrl_c):
    mapper = mapper_for(drive, kind=sslcd.AsyncMapper, most_waiting=10**6)
    for frame in drive:
        mapper.add(frame)
    for _ in range(200):  # half a minute of work
        mapper.refine()
    threading.Timer(0.3, lambda: _thread.interrupt_main(signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        mapper.wait()
    assert time.monotonic() - begin < 10
    mapper.close()


@pytest.mark.parametrize("matcher", ["None", "lambda query: time.sleep(.001)"])
def test_an_interpreter_may_end_with_a_mapper_at_work(matcher):
    script = f"""
import sslcd, time
drive = sslcd.load_dataset({str(DATA / "sim_rectangle")!r})
mapper = sslcd.AsyncMapper(place_matcher={matcher}, most_waiting=10**6)
for frame in drive:
    mapper.add(frame)
mapper.refine()
print("end")
"""
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, "end\n", "")


def test_a_refinement_on_the_way_is_one_between_two_frames(drive):
    later = len(drive) * 3 // 4
    in_turn = mapper_for(drive)
    with mapper_for(
        drive, kind=sslcd.AsyncMapper, most_waiting=10**6, refine_every_m=0
    ) as mapper:
        for i, frame in enumerate(drive):
            in_turn.add(frame)
            mapper.add(frame)
            if i == later:
                in_turn.refine(at_end=False)
                mapper.refine(at_end=False)
        assert mapper.snapshot().trajectory.tum() == in_turn.trajectory.tum()


def test_refine_every_m_is_a_path():
    with pytest.raises(sslcd.BadConfigError, match="refine_every_m"):
        sslcd.AsyncMapper(refine_every_m=-1)
    with pytest.raises(sslcd.UsageError, match="refine_every_m"):
        sslcd.AsyncMapper(refine_every_m="often")
