# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

rerun = pytest.importorskip("rerun", reason="no rerun-sdk: pip install 'sslcd[rerun]'")

from sslcd.rerun import _quaternion, write_rrd  # noqa: E402


def test_a_recording_holds_the_run(tmp_path, drive, offline):
    path = tmp_path / "run.rrd"
    write_rrd(path, offline.trajectory, offline.objects, offline.loops, up=drive.up)
    small = tmp_path / "small.rrd"
    write_rrd(small, offline.trajectory, up=(0, 0, 1))
    content = path.read_bytes()
    labels = {each.label for each in offline.objects if each.state == "confirmed"}
    for name in ("trajectory", "camera", "loops", *(f"objects/{label}" for label in labels)):
        assert f"/map/{name}".encode() in content
    assert path.stat().st_size > small.stat().st_size and b"/map/objects" not in small.read_bytes()


def test_quaternions_of_rotations():
    rng = np.random.default_rng(1)
    for q in [*np.eye(4), *rng.normal(size=(100, 4))]:
        x, y, z, w = q / np.linalg.norm(q)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        R = np.eye(3) + 2 * w * cross + 2 * cross @ cross
        assert abs(abs(_quaternion(R) @ (x, y, z, w)) - 1) < 1e-12
