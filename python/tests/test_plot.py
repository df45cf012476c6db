# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib", reason="no matplotlib: pip install 'sslcd[plot]'")
matplotlib.use("Agg")

from sslcd.plot import draw  # noqa: E402


def test_a_map_from_above(tmp_path, drive, offline):
    axes = draw(
        offline.trajectory,
        offline.objects,
        offline.loops,
        odometry=offline.odometry,
        groundtruth=drive.groundtruth,
        up=drive.up,
    )
    accepted = sum(loop.accepted for loop in offline.loops)
    names = axes.get_legend_handles_labels()[1]
    labels = {each.label for each in offline.objects if each.state == "confirmed"}
    assert set(names) == labels | {"ground truth", "odometry", "sslcd", f"{accepted} loops"}
    path = axes.get_lines()[-1].get_xydata()  # KITTI axes: x to the right, z ahead
    assert np.allclose(path, offline.trajectory.positions[:, [0, 2]])
    outlines = sum(len(each.get_paths()) for each in axes.collections) - accepted
    assert outlines == sum(each.state == "confirmed" for each in offline.objects)
    axes.figure.savefig(tmp_path / "map.png")
    assert (tmp_path / "map.png").stat().st_size > 10000


def test_nothing_to_draw(offline):
    axes = matplotlib.pyplot.figure().gca()
    assert draw(offline.trajectory, axes=axes) is axes and len(axes.collections) == 0
