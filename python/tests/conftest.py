# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: data of tests/data, the program sslcd_run, real data where there is any."""

import os
import signal
from pathlib import Path

import numpy as np
import pytest

import sslcd

SOURCE = Path(__file__).resolve().parents[2]
DATA = SOURCE / "tests" / "data"


def translation(x, y, z):
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


@pytest.fixture(scope="session")
def drive():
    """Out, and back in the opposite direction past the same cars."""
    return sslcd.load_dataset(DATA / "sim_out_and_back", groundtruth="groundtruth.txt")


@pytest.fixture(scope="session")
def offline(drive):
    return sslcd.run(drive)


@pytest.fixture(scope="session")
def sslcd_run():
    program = os.environ.get("SSLCD_RUN", "")
    if not program:
        pytest.skip("SSLCD_RUN does not name the program sslcd_run")
    return program


@pytest.fixture
def ctrl_c():
    """Lets SIGINT interrupt, also where the tests run in the background and ignore it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def mapper():
    return sslcd.Mapper(labels={"Tree": "full"})


@pytest.fixture
def pair():
    """Arguments of add_frame for two detections."""
    return {
        "labels": ["Car", "Tree"],
        "poses": np.stack([translation(1, 1, 10), translation(-3, 1, 12)]),
        "dims": np.array([[4, 1.8, 1.5], [1, 1, 5]]),
        "scores": np.array([0.9, 0.8]),
    }


def context_of(dataset):
    return {"labels": dataset.labels, "up": dataset.up, "camera": dataset.camera}


def mapper_for(dataset, options=None, kind=sslcd.Mapper, **more):
    return kind(options, **context_of(dataset), **more)


def arrays_of(frame):
    """The arguments of add_frame for a Frame, as a host would give them."""
    return {
        "stamp": frame.stamp,
        "T_odom_cam": np.array(frame.T_odom_cam),
        "labels": list(frame.labels),
        "poses": np.array(frame.poses),
        "dims": np.array(frame.dims),
        "scores": np.array(frame.scores),
        "boxes": frame.boxes,
        "embeddings": frame.embeddings,
        "colours": frame.colours,
        "index": frame.index,
        "step": frame.step,
    }
