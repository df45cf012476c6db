# SPDX-License-Identifier: BSD-3-Clause
"""Drives and a cluster for the tests of fleets."""

import shutil
import warnings

import numpy as np
import pytest

from conftest import DATA

pytest.importorskip("distributed")
pytest.importorskip("fsspec")

from distributed import Client  # noqa: E402


@pytest.fixture(scope="module")
def client():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with Client(
            processes=False, n_workers=1, threads_per_worker=2, dashboard_address=None
        ) as made:
            yield made


def cut(source, target, frames):
    """The first frames of a drive, as another drive."""
    target.mkdir(parents=True)
    for name in ("calib.txt", "sequence.yaml"):
        shutil.copy(source / name, target)
    for name in ("times.txt", "odometry.txt"):
        lines = (source / name).read_text().splitlines(True)
        (target / name).write_text("".join(lines[:frames]))
    rows = (source / "detections.txt").read_text().splitlines(True)
    rows = [row for row in rows if int(row.split()[0]) < frames]
    (target / "detections.txt").write_text("".join(rows))
    np.save(target / "embeddings.npy", np.load(source / "embeddings.npy")[: len(rows)])
    return target


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two drives of one site, one of another site."""
    folder = tmp_path_factory.mktemp("drives")
    cut(DATA / "sim_out_and_back", folder / "monday", 1000)
    cut(DATA / "sim_out_and_back", folder / "tuesday", 60)
    cut(DATA / "sim_rectangle", folder / "elsewhere", 60)
    return folder
