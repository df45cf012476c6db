# SPDX-License-Identifier: BSD-3-Clause
# %% [markdown]
# # A map of parked cars
# Detections and odometry in KITTI's axes, mapped and compared with the true trajectory. The data is
# a simulated drive of `tests/data`. For KITTI tracking:
# `load_dataset("kitti/training", sequence="0007", detections=..., odometry=...)`.

# %%
from pathlib import Path

import numpy as np

import sslcd
from sslcd.plot import draw

data = Path(__file__).resolve().parents[2] / "tests" / "data" / "sim_rectangle"
drive = sslcd.load_dataset(data)
frame = drive[0]
print(f"{len(drive)} frames; the first one: {list(frame.labels)}, poses {frame.poses.shape}")

# %% [markdown]
# Map it, with all options at their defaults.

# %%
result = sslcd.run(drive)
print(f"scale of the odometry: {result.scale:.4f}")
print(f"{sum(loop.accepted for loop in result.loops)} loops accepted, of {len(result.loops)} tried")

# %% [markdown]
# How good is the trajectory? The errors are those of evo.

# %%
before = sslcd.ate(result.odometry, drive.groundtruth, "sim3").error
after = sslcd.ate(result.trajectory, drive.groundtruth, "sim3").error
print(f"ATE: odometry {before.rmse:.2f} m, sslcd {after.rmse:.2f} m")
assert after.rmse < before.rmse

# %% [markdown]
# The objects of the map, and the picture from above.

# %%
parked = [each for each in result.objects if each.state == "confirmed"]
for label in sorted({each.label for each in parked}):
    lengths = [each.dims[0] for each in parked if each.label == label]
    print(f"{label:6} {len(lengths):4} objects, {np.mean(lengths):.1f} m long")
axes = draw(
    result.trajectory,
    result.objects,
    result.loops,
    odometry=result.odometry,
    groundtruth=drive.groundtruth,
    up=drive.up,
)
axes.figure.savefig("kitti_map.png")

# %% [markdown]
# All files of a run: trajectory for evo, map, loops with their reasons, pose graph.

# %%
for path in result.write("kitti_map"):
    print(path)
