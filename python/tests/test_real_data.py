# SPDX-License-Identifier: BSD-3-Clause
import os
from pathlib import Path

import pytest

import sslcd
from conftest import mapper_for

REAL = Path(os.environ.get("SSLCD_DATA_DIR") or "/none")


def test_streaming_of_real_data_is_the_offline_run_to_the_byte():
    folder = REAL / "kitti-odometry-poles" / "02"
    if not folder.is_dir():
        pytest.skip(f"SSLCD_DATA_DIR has no {folder.relative_to(REAL)}")
    dataset = sslcd.load_dataset(folder)
    mapper = mapper_for(dataset)
    for frame in dataset:
        mapper.add(frame)
    streamed = sum(loop.accepted for loop in mapper.loops)
    mapper.refine()
    offline = sslcd.run(dataset)
    assert mapper.trajectory.tum() == offline.trajectory.tum()
    assert streamed >= 0.95 * sum(loop.accepted for loop in offline.loops)
