#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lower bound of the ATE with loops: the ATE of an odometry, and of the optimal estimate with exactly
known noise.

Reads graph.g2o of a run. Edges between successive frames are odometry, the others are measurements.
Draws their errors from their covariances many times and computes the most likely trajectory each time
(linearised least squares), which no estimator beats on average. Prints the ATE of both after SE(3)
alignment, and how often the estimate has at most half of it. Needs no ground truth, only the
covariances. `--step-mm` and `--step-mrad` replace the standard deviations of one odometry step along
its own x, y, z; `--exact` assumes exact measurements.
"""
import argparse

import numpy as np


def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rotation(x, y, z, w):
    v = np.array([x, y, z])
    return np.eye(3) + 2 * w * hat(v) + 2 * hat(v) @ hat(v)


def read_graph(path):
    """Positions and rotations of the frames in order; (from, to, covariance 6x6 [t, r]) of all edges."""
    poses, edges = {}, []
    for line in open(path):
        words = line.split()
        if words[:1] == ["VERTEX_SE3:QUAT"]:
            values = [float(w) for w in words[2:9]]
            poses[int(words[1])] = (np.array(values[:3]), rotation(*values[3:]))
        elif words[:1] == ["EDGE_SE3:QUAT"]:
            information = np.zeros((6, 6))
            information[np.triu_indices(6)] = [float(w) for w in words[10:31]]
            information += np.triu(information, 1).T
            edges.append((int(words[1]), int(words[2]), np.linalg.inv(information)))
    number = {name: i for i, name in enumerate(sorted(poses))}
    ordered = [poses[name] for name in sorted(poses)]
    edges = [(number[a], number[b], covariance) for a, b, covariance in edges]
    return np.array([p for p, _ in ordered]), [R for _, R in ordered], edges


def drift(position, R, roots):
    """Jacobian of the errors of all frames (position, rotation; in world axes) by the steps' noise of unit
    variance."""
    n = len(position)
    by_noise = np.zeros((6 * n, 6 * (n - 1)))
    for i in range(n - 1):
        onward, turned = np.eye(6), np.zeros((6, 6))
        onward[:3, 3:] = -hat(position[i + 1] - position[i])
        turned[:3, :3] = turned[3:, 3:] = R[i + 1]
        by_noise[6 * i + 6 : 6 * i + 12] = onward @ by_noise[6 * i : 6 * i + 6]
        by_noise[6 * i + 6 : 6 * i + 12, 6 * i : 6 * i + 6] = turned @ roots[i]
    return by_noise


def seen_by(a, b, position, R, by_noise):
    """Jacobian of the error of T_a_b in b's axes by the noise of the steps."""
    e_a, e_b = by_noise[6 * a : 6 * a + 6], by_noise[6 * b : 6 * b + 6]
    shift = e_b[:3] - e_a[:3] + hat(position[b] - position[a]) @ e_a[3:]
    return np.vstack([R[b].T @ shift, R[b].T @ (e_b[3:] - e_a[3:])])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("graph", help="graph.g2o of a run")
    parser.add_argument("--step-mm", type=float, nargs=3, metavar=("X", "Y", "Z"))
    parser.add_argument("--step-mrad", type=float, nargs=3, metavar=("X", "Y", "Z"))
    parser.add_argument("--exact", action="store_true")
    parser.add_argument("--trials", type=int, default=300)
    arguments = parser.parse_args()
    try:
        position, R, edges = read_graph(arguments.graph)
    except (OSError, ValueError, IndexError, KeyError, np.linalg.LinAlgError) as error:
        parser.error(f"{arguments.graph}: cannot be read as the graph.g2o of a run: {error}")
    steps = {b: covariance for a, b, covariance in edges if b == a + 1}
    measured = [edge for edge in edges if edge[1] != edge[0] + 1]
    if len(steps) != len(position) - 1 or not measured:
        parser.error(f"{arguments.graph}: needs odometry between all successive frames, and a loop or tie")

    roots = [np.linalg.cholesky(steps[i]) for i in range(1, len(position))]
    for part, given in ((slice(0, 3), arguments.step_mm), (slice(3, 6), arguments.step_mrad)):
        for root in roots if given else []:
            root[part] = 0
            root[part, part] = 1e-3 * np.diag(given)
    by_noise = drift(position, R, roots)
    factor = 1e-3 if arguments.exact else 1
    whiten = [np.linalg.inv(factor * np.linalg.cholesky(covariance)) for _, _, covariance in measured]
    seen = np.vstack([W @ seen_by(a, b, position, R, by_noise) for W, (a, b, _) in zip(whiten, measured)])

    n = len(position)
    rigid = np.vstack([np.hstack([np.eye(3), -hat(p - position.mean(0))]) for p in position])
    rigid = np.linalg.qr(rigid)[0]
    shifts = by_noise.reshape(n, 6, -1)[:, :3].reshape(3 * n, -1)
    shifts = shifts - rigid @ (rigid.T @ shifts)
    random = np.random.default_rng(1)
    noise = random.normal(size=(seen.shape[1], arguments.trials))
    answer = seen @ noise + random.normal(size=(seen.shape[0], arguments.trials))
    gain = np.linalg.solve(seen @ seen.T + np.eye(len(seen)), answer)
    ate = lambda errors: np.sqrt((errors**2).sum(0) / n)
    before, after = ate(shifts @ noise), ate(shifts @ (noise - seen.T @ gain))
    ratio = after / before
    low, middle, high = np.quantile(ratio, (0.1, 0.5, 0.9))
    print(
        f"{len(measured)} measurements  ATE {before.mean():.4f} -> {after.mean():.4f} m  ratio: mean {ratio.mean():.2f}, "
        f"median {middle:.2f}, 10 to 90 % {low:.2f} to {high:.2f}; at most .5 in {100 * (ratio <= 0.5).mean():.0f} %"
    )


if __name__ == "__main__":
    main()
