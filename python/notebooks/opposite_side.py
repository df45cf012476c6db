# SPDX-License-Identifier: BSD-3-Clause
# %% [markdown]
# # Loops from the opposite side
# A camera drives out and comes back along the same lane. Images look different from the other side;
# the layout of the objects does not. Frames are streamed, as a robot would.

# %%
from pathlib import Path

import numpy as np

import sslcd
from sslcd.plot import draw

data = Path(__file__).resolve().parents[2] / "tests" / "data" / "sim_out_and_back"
drive = sslcd.load_dataset(data)
mapper = sslcd.Mapper(labels=drive.labels, up=drive.up, camera=drive.camera)
for frame in drive:
    report = mapper.add(frame)
    for loop in report.changes.loops:  # new, changed or taken back
        moved = np.linalg.norm(report.T_world_cam[:3, 3] - frame.T_odom_cam[:3, 3])
        print(f"frame {frame.index}: {loop.decision}, {loop.reason}; correction {moved:.2f} m")

# %% [markdown]
# Why are there no more loops? The mapper says it in a line.

# %%
print(mapper.loop_search)

# %% [markdown]
# `refine()` searches a second time with all it knows, and optimises poses, objects and scale.

# %%
mapper.refine()
accepted = [loop for loop in mapper.loops if loop.accepted]
angles = np.degrees([loop.viewpoint_change for loop in accepted])
print(f"{len(accepted)} loops; the two headings differ by {angles.min():.0f} to {angles.max():.0f}")
assert angles.max() > 135

# %% [markdown]
# Each loop is an edge of a pose graph: a relative pose with its covariance, and the matched objects.

# %%
loop = accepted[0]
print(
    f"camera {loop.query_frame} seen from camera {loop.match_frame}:\n{loop.T_match_query.round(2)}"
)
print("sigma [m, rad]:", np.sqrt(np.diag(loop.covariance)).round(3))
print("matched objects:", loop.pairs[:, 1])

# %%
axes = draw(mapper.trajectory, mapper.objects, accepted, groundtruth=drive.groundtruth, up=drive.up)
axes.figure.savefig("opposite_side.png")
