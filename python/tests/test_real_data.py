# SPDX-License-Identifier: BSD-3-Clause
import os
from pathlib import Path

import pytest

import sslcd
from conftest import mapper_for

REAL = Path(os.environ.get("SSLCD_DATA_DIR") or "/none")


@pytest.mark.parametrize("name", ["victoria-park", "kitti-odometry-poles/02"])
def test_streaming_of_real_data_is_the_offline_run_to_the_byte(name):
    if not (REAL / name).is_dir():
        pytest.skip(f"SSLCD_DATA_DIR has no {name}")
    dataset = sslcd.load_dataset(REAL / name)
    mapper = mapper_for(dataset)
    for frame in dataset:
        mapper.add(frame)
    streamed = sum(loop.accepted for loop in mapper.loops)
    mapper.refine()
    offline = sslcd.run(dataset)
    assert mapper.trajectory.tum() == offline.trajectory.tum()
    assert streamed >= 0.95 * sum(loop.accepted for loop in offline.loops)
