# SPDX-License-Identifier: BSD-3-Clause
# %% [markdown]
# # Your own detector
# What a detector has to deliver, and a mapper on a thread of its own that never blocks the camera.

# %%
from pathlib import Path

import numpy as np

import sslcd

# %% [markdown]
# The detector of this notebook reads KITTI's rows from a file. Yours is a network: any function from
# an image to labels, scores and cuboids will do.

# %%
data = Path(__file__).resolve().parents[2] / "tests" / "data" / "sim_out_and_back"
rows = [line.split() for line in (data / "detections.txt").read_text().splitlines()]
embeddings = np.load(data / "embeddings.npy")
frame_of_row = np.array([int(row[0]) for row in rows])


def detect(frame):
    mine = np.flatnonzero(frame_of_row == frame)
    numbers = np.array([rows[i][3:] for i in mine], dtype=float).reshape(-1, 15)
    poses, dims = sslcd.kitti_cuboids(numbers[:, 10:13], numbers[:, 13], numbers[:, 7:10])
    return {
        "labels": [rows[i][2] for i in mine],
        "poses": poses,  # [N, 4, 4] centre of the cuboid in the camera
        "dims": dims,  # [N, 3] length, width, height
        "scores": numbers[:, 14],  # probabilities
        "boxes": numbers[:, 3:7],  # pixels
        "embeddings": embeddings[mine],  # for telling objects of one class apart
    }


# %% [markdown]
# The odometry is yours, too: a pose of the camera per frame, in metres. Tell the mapper which way is
# up in its world, and which classes have no heading.

# %%
stamps = np.loadtxt(data / "times.txt")
odometry = sslcd.load_dataset(data)  # only for its poses
settings = {"labels": {"Tree": "full", "Pole": "full"}, "up": (0, -1, 0)}
with sslcd.AsyncMapper({"filter": {"min_score": 0.4}}, **settings, most_waiting=1000) as mapper:
    for i, stamp in enumerate(stamps):
        taken = mapper.add_frame(stamp, odometry[i].T_odom_cam, index=i, **detect(i))
        assert taken, "the queue is full: the frame was dropped and counted"
        changes = mapper.take_report().changes  # returns at once
    mapper.refine()
    result = mapper.snapshot()  # waits for all of it

# %%
print(result.loop_search)
error = sslcd.ate(result.trajectory, odometry.groundtruth, "sim3").error
print(f"ATE {error.rmse:.2f} m, {len(result.objects)} objects")
assert error.rmse < 0.5

# %% [markdown]
# Wrong input is refused with its reason, and the mapper keeps its state.

# %%
for wrong in ({"poses": np.eye(4)[None] * 2}, {"scores": [0.5, 0.5]}, {"dims": [[4, 2]]}):
    one = {"labels": ["Car"], "poses": np.eye(4)[None], "dims": [[4, 2, 1.5]], **wrong}
    try:
        result.add_frame(stamps[-1] + 1, np.eye(4), **one)
    except sslcd.Error as problem:
        print(f"{type(problem).__name__}: {problem}")
