# SPDX-License-Identifier: BSD-3-Clause
"""usage: evo_reference.py EST REF MAX_DIFFERENCE
Prints what evo says about two TUM files, as rows `key value`; and a 4-DoF alignment about -y found by plain search."""
import copy
import sys

import numpy as np
from evo.core import metrics, sync
from evo.tools import file_interface
from scipy.optimize import minimize_scalar


def show(key, metric):
    for name, value in metric.get_all_statistics().items():
        print(f"{key}.{name} {value:.17g}")
    print(f"{key}.count {len(metric.error)}")


def ape(key, ref, est):
    metric = metrics.APE(metrics.PoseRelation.translation_part)
    metric.process_data((ref, est))
    show(key, metric)


def yaw_rmse(yaw, p, q):
    c, s = np.cos(yaw), np.sin(yaw)
    rotation = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return np.sqrt((((p @ rotation.T) - q) ** 2).sum(1).mean())


def main():
    est = file_interface.read_tum_trajectory_file(sys.argv[1])
    ref = file_interface.read_tum_trajectory_file(sys.argv[2])
    ref, est = sync.associate_trajectories(ref, est, max_diff=float(sys.argv[3]))

    ape("none", ref, est)
    for key, scale in (("se3", False), ("sim3", True)):
        aligned = copy.deepcopy(est)
        print(f"{key}.scale {aligned.align(ref, correct_scale=scale)[2]:.17g}")
        ape(key, ref, aligned)

    p, q = (t.positions_xyz - t.positions_xyz.mean(0) for t in (est, ref))
    start = min(np.linspace(-np.pi, np.pi, 721), key=lambda yaw: yaw_rmse(yaw, p, q))
    best = minimize_scalar(yaw_rmse, bracket=(start - 0.01, start, start + 0.01), args=(p, q), tol=1e-12)
    print(f"4dof.rmse {best.fun:.17g}")

    for delta, unit, all_pairs in ((1, "f", 0), (7, "f", 0), (7, "f", 1), (5, "m", 0), (5, "m", 1)):
        for relation in ("translation_part", "rotation_angle_rad"):
            metric = metrics.RPE(metrics.PoseRelation[relation], delta,
                                 metrics.Unit.frames if unit == "f" else metrics.Unit.meters, all_pairs=bool(all_pairs))
            metric.process_data((ref, est))
            show(f"rpe{delta}{unit}{'all' if all_pairs else ''}.{relation}", metric)


main()
