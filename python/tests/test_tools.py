# SPDX-License-Identifier: BSD-3-Clause
"""Evaluation, pose graphs and matching of layouts."""

import csv
import subprocess
import warnings
from dataclasses import replace

import numpy as np
import pytest

import sslcd
from conftest import DATA, translation


def turned(yaw, *t):
    T = translation(*t)
    T[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    return T


def test_ate_of_a_moved_and_scaled_trajectory():
    rng = np.random.default_rng(1)
    reference = np.stack([turned(0.1 * i, *rng.normal(size=3)) for i in range(20)])
    S = turned(0.5, 3, 2, 1)
    estimate = np.linalg.inv(S) @ reference
    estimate[:, :3, 3] /= 2
    result = sslcd.ate(estimate, reference, "sim3")
    assert result.error.rmse < 1e-9 and result.scale == pytest.approx(2) and result.unique
    assert result.error.count == len(result.errors) == 20
    assert sslcd.ate(reference, reference, "none").error.max == 0
    assert sslcd.ate(estimate, reference, "4dof", up=(0, 0, 1)).error.rmse > 0.1
    assert sslcd.rpe(S @ reference, reference).translation.rmse < 1e-9
    assert sslcd.rpe(reference, reference, 2, "metres").rotation.count > 0


def test_trajectories_are_matched_by_stamps(offline, drive):
    every_second = replace(
        offline.trajectory,
        stamps=offline.trajectory.stamps[::2] + 0.004,
        poses=offline.trajectory.poses[::2],
    )
    assert sslcd.ate(every_second, drive.groundtruth).error.count == len(every_second)
    late = replace(every_second, stamps=every_second.stamps + 1e6)
    with pytest.raises(sslcd.NoSolutionError):
        sslcd.ate(late, drive.groundtruth)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ((np.zeros((2, 3)), np.zeros((2, 3))), "estimate has the shape"),
        ((np.zeros((0, 4, 4)), np.zeros((0, 4, 4))), "no poses"),
        ((np.eye(4)[None], np.stack([np.eye(4)] * 2)), "poses"),
        ((np.eye(4)[None], np.full((1, 4, 4), np.nan)), "finite"),
        ((np.eye(4)[None], np.eye(4)[None], "sim4"), "sim4"),
    ],
)
def test_bad_trajectories_raise(arguments, message):
    with pytest.raises(sslcd.Error, match=message):
        sslcd.ate(*arguments)


def test_a_trajectory_and_an_array_do_not_mix(offline):
    with pytest.raises(sslcd.UsageError, match="two of one kind"):
        sslcd.ate(offline.trajectory, offline.trajectory.poses)


def test_a_pose_graph_with_false_loops(tmp_path, sslcd_run):
    graph = sslcd.read_g2o(DATA / "loops.g2o")
    truth = sslcd.read_g2o(DATA / "loops_truth.g2o")
    robust = sslcd.solve_graph(graph, robust=True)
    assert robust.converged and robust.kept.sum() == len(graph.edges) - 16
    assert robust.graph.poses.shape == graph.poses.shape and not np.array_equal(
        robust.graph.poses, graph.poses
    )
    error = lambda solved: sslcd.ate(solved.graph.poses, truth.poses).error.rmse
    assert error(robust) < 0.3 * error(sslcd.solve_graph(graph))
    subprocess.run(
        [
            sslcd_run,
            "graph",
            DATA / "loops.g2o",
            "--robust",
            "--out",
            tmp_path / "out.g2o",
            "--quiet",
        ],
        check=True,
    )
    kept = replace(
        robust.graph,
        **{
            name: getattr(robust.graph, name)[robust.kept]
            for name in ("edges", "measurements", "information", "loops")
        },
    )
    assert kept.g2o() == (tmp_path / "out.g2o").read_text()


def test_graphs_go_round_through_a_file(tmp_path, offline):
    (tmp_path / "graph.g2o").write_text(offline.graph.g2o())
    again = sslcd.read_g2o(tmp_path / "graph.g2o")
    assert np.array_equal(again.ids, offline.graph.ids) and np.allclose(
        again.poses, offline.graph.poses
    )
    assert np.allclose(again.information, offline.graph.information) and not again.planar


def test_a_graph_of_a_plane(tmp_path):
    file = tmp_path / "plane.g2o"
    file.write_text(
        "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 2 0 0 1 0 0 1 0 1\nPOINT 3 1 1\n"
    )
    with pytest.warns(UserWarning, match="1 rows of other kinds"):
        graph = sslcd.read_g2o(file)
    solution = sslcd.solve_graph(graph)
    assert (
        graph.planar and solution.graph.planar and solution.graph.poses[1, 0, 3] == pytest.approx(2)
    )


@pytest.mark.parametrize(
    "change, message",
    [
        ({"poses": np.zeros((1, 4, 4))}, "poses has 1 rows, expected 2"),
        ({"edges": np.array([[0, 1, 2]])}, r"edges has the shape \(1, 3\)"),
        ({"information": np.eye(6)}, "information"),
    ],
)
def test_graphs_of_wrong_shapes_raise(change, message):
    good = dict(
        ids=[0, 1],
        poses=np.stack([np.eye(4)] * 2),
        fixed=[True, False],
        edges=[[0, 1]],
        measurements=np.eye(4)[None],
        information=np.eye(6)[None],
        loops=[False],
    )
    assert sslcd.solve_graph(sslcd.PoseGraph(**good)).chi2_after == 0
    with pytest.raises(sslcd.UsageError, match=message):
        sslcd.PoseGraph(**{**good, **change})


def test_graphs_without_a_solution_raise():
    graph = sslcd.PoseGraph(
        [0], np.eye(4)[None], [False], [[0, 5]], np.eye(4)[None], np.eye(6)[None], [False]
    )
    with pytest.raises(sslcd.NoSolutionError):
        sslcd.solve_graph(graph)
    for arguments in ({"dof": 5}, {"start": "random"}):
        with pytest.raises(sslcd.UsageError, match="must be one of"):
            sslcd.solve_graph(graph, **arguments)
    empty = sslcd.PoseGraph([], [], [], [], [], [], [])
    assert empty.poses.shape == (0, 4, 4)
    with pytest.raises(sslcd.BadInputError, match="nowhere.g2o"):
        sslcd.read_g2o("nowhere.g2o")


def test_pairs_of_layouts_as_the_program(tmp_path, sslcd_run):
    out = tmp_path / "answers.csv"
    subprocess.run(
        [sslcd_run, "match", DATA / "object_pairs.txt", "--out", out, "--quiet"], check=True
    )
    with open(out) as file:
        answers = {int(row["pair"]): row for row in csv.DictReader(file)}
    pairs = sslcd.read_layout_pairs(DATA / "object_pairs.txt")
    assert len(pairs) == len(answers) == 40
    for id, local, global_ in pairs[::4]:
        result, answer = sslcd.match(local, global_), answers[id]
        assert result.decision == answer["decision"] and result.score == pytest.approx(
            float(answer["score"]), abs=2e-3
        )
        if result.hypotheses:
            best = result.hypotheses[0]
            assert best.yaw == pytest.approx(float(answer["yaw_rad"]), abs=1e-5)
            assert best.T_global_local[:3, 3] == pytest.approx(
                [float(answer[t]) for t in ("tx", "ty", "tz")], abs=1e-3
            )
            assert len(best.matches) == int(answer["matches"])


def test_matching_finds_a_turned_map():
    rng = np.random.default_rng(2)
    positions = np.c_[rng.uniform(-40, 40, (60, 2)), np.zeros(60)]
    labels = rng.choice(["Car", "Tree", "Pole"], 60)
    T = turned(2.5, 12, -7, 0.5)
    near = np.linalg.norm(positions, axis=1) < 25
    local = sslcd.Layout(labels[near], (positions[near] - T[:3, 3]) @ T[:3, :3])
    result = sslcd.match(local, sslcd.Layout(labels, positions))
    assert result.accepted and np.allclose(result.hypotheses[0].T_global_local, T, atol=0.01)
    assert np.array_equal(np.flatnonzero(near), result.hypotheses[0].matches[:, 1])
    unknown = sslcd.Layout(["Bench"] * near.sum(), local.positions)
    assert not sslcd.match(unknown, sslcd.Layout(labels, positions)).accepted
    assert sslcd.match(sslcd.Layout([], []), sslcd.Layout([], [])).decision == "none"
    assert not sslcd.match(
        sslcd.Layout(local.labels, local.positions * np.nan), sslcd.Layout(labels, positions)
    ).accepted


def test_layouts_of_maps_and_wrong_ones(offline, drive):
    layout = sslcd.Layout.of_objects(offline.objects, drive.labels, drive.up)
    assert len(layout) == sum(each.state == "confirmed" for each in offline.objects) > 10
    whole = sslcd.match(layout, layout)
    assert whole.accepted and np.allclose(whole.hypotheses[0].T_global_local, np.eye(4), atol=1e-6)
    for bad, message in (
        ({"labels": ["Car"], "positions": np.zeros((2, 3))}, "positions has 2 rows"),
        ({"labels": ["Car"], "positions": [[0, 0, 0]], "symmetries": ["full", "pi"]}, "symmetries"),
        ({"labels": ["Car"], "positions": [[0, 0, 0]], "yaws": 1.0}, "yaws has the shape"),
    ):
        with pytest.raises(sslcd.UsageError, match=message):
            sslcd.Layout(**bad)
    with pytest.raises(sslcd.UsageError, match="symmetry is 'round'"):
        sslcd.match(sslcd.Layout(["Car"], [[0, 0, 0]], symmetries=["round"]), layout)
    with pytest.raises(sslcd.BadConfigError, match="unknown key"):
        sslcd.match(layout, layout, {"loop": {"layout": {"every_m": 4}}})


def test_no_warnings_where_all_is_well():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sslcd.read_g2o(DATA / "loops.g2o")
