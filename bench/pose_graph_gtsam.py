#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""pose_graph_bench and, where it is installed (pip install gtsam), GTSAM on the same graphs: ours, theirs, ours again,
because a machine's speed drifts.

usage: pose_graph_gtsam.py POSE_GRAPH_BENCH DATA_FOLDER"""
import glob
import os
import subprocess
import sys
import tempfile
import time

REPETITIONS = 5


def best_of(run):
    """The result, and the fastest run's CPU seconds."""
    best = float('inf')
    for _ in range(REPETITIONS):
        start = time.process_time()
        result = run()
        best = min(best, time.process_time() - start)
    return result, best


def ate(values, truth):
    """RMSE of the positions after the best rigid alignment; pose i belongs to row i of `truth` (KITTI's format)."""
    estimate = np.array([values.atPose3(i).translation() for i in range(len(truth))])
    true = truth[:, [3, 7, 11]]
    e, t = estimate - estimate.mean(0), true - true.mean(0)
    u, _, vt = np.linalg.svd(e.T @ t)
    flip = np.diag([1, 1, np.linalg.det(u @ vt)])
    return np.sqrt(((e @ (u @ flip @ vt) - t) ** 2).sum(1).mean())


def read(path):
    """The graph with its first pose held, and the start."""
    graph, start = gtsam.readG2o(path, True)
    first = min(start.keys())
    graph.add(gtsam.PriorFactorPose3(first, start.atPose3(first), gtsam.noiseModel.Isotropic.Variance(6, 1e-12)))
    return graph, start


def minimum(path, chordal):
    graph, start = read(path)

    def solve():
        first = gtsam.InitializePose3.initialize(graph) if chordal else start
        return gtsam.LevenbergMarquardtOptimizer(graph, first, gtsam.LevenbergMarquardtParams()).optimize()
    values, seconds = best_of(solve)
    name = os.path.basename(path)[:-4] + (' chordal' if chordal else '')
    print(f'{name:24} chi2 {2 * graph.error(start):.6g} -> {2 * graph.error(values):.6g}  seconds {seconds:.3f}', flush=True)


def main(bench, data):
    with tempfile.TemporaryDirectory() as folder:
        print('sslcd', flush=True)
        subprocess.run([bench, data, folder], check=True)
        if gtsam is None:
            print('GTSAM is not installed: skipped')
            return
        print('GTSAM', flush=True)
        for name in ('sphere2500', 'parking-garage'):
            path = f'{data}/g2o/{name}.g2o'
            if not os.path.exists(path):
                continue
            minimum(path, chordal=False)
            minimum(path, chordal=True)
        for name in ('torus', 'torus-indefinite'):  # ours, too, takes the chordal start
            minimum(f'{folder}/{name}.g2o', chordal=True)
        for path in sorted(glob.glob(folder + '/synthetic*.g2o')):
            graph, start = read(path)
            truth = np.loadtxt(path.replace('.g2o', '.truth'))
            params = gtsam.GncLMParams(gtsam.LevenbergMarquardtParams())
            odometry = [i for i in range(graph.size()) if len(graph.at(i).keys()) < 2
                        or abs(graph.at(i).keys()[0] - graph.at(i).keys()[1]) == 1]
            params.setKnownInliers(odometry)
            plain = gtsam.LevenbergMarquardtOptimizer(graph, start, gtsam.LevenbergMarquardtParams()).optimize()
            values, seconds = best_of(lambda: gtsam.GncLMOptimizer(graph, start, params).optimize())
            print(f'{os.path.basename(path)[:-4]:16} ATE plain {ate(plain, truth):.2f}  GNC {ate(values, truth):.3f} m  '
                  f'seconds {seconds:.3f}', flush=True)
        print('sslcd again', flush=True)
        subprocess.run([bench, data, folder], check=True)


if __name__ == '__main__':
    try:
        import gtsam
        import numpy as np
    except ImportError:
        gtsam = None
    main(*sys.argv[1:3])
