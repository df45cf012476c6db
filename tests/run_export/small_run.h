// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>

#include "report/run_view.h"

namespace sslcd {

/// Three poses 10 m apart, straight ahead; a car 5 m and a tree 9 m to the right of the second one;
/// a loop of the last pose to the first. The first camera is far from the origin.
inline RunView SmallRun(const Vec3& up = Vec3(0, -1, 0)) {
  RunView run;
  run.folder = "runs/small";
  run.record.emplace();
  run.record->dataset = "small";
  run.record->labels.Set("Tree<", {Symmetry::kFull});
  run.map.up_axis = up;
  run.gravity = GravityFrame::FromUp(up);
  const auto at = [&run](double right, double ahead) -> Vec3 {
    return Vec3(500, -200, 300) + run.gravity.forward * right + run.gravity.left * ahead;
  };
  // looks along `left`, with its y axis down
  Eigen::Matrix3d R_world_cam;
  R_world_cam << run.gravity.forward, -run.gravity.up, run.gravity.left;
  for (int i = 0; i < 3; ++i) {
    run.trajectory.stamps.push_back(i);
    run.trajectory.poses.emplace_back(lie::SO3<double>(Eigen::Quaterniond(R_world_cam)),
                                      at(0, 10 * i));
  }
  run.odometry = run.trajectory;
  for (const auto& [id, label, right] : {std::tuple{3, "Tree<", 9.}, std::tuple{12, "Car", 5.}}) {
    MapObject object;
    object.id.value = id;
    object.label = label;
    object.state = LandmarkState::kConfirmed;
    object.T_world_object = Pose(run.gravity.Upright(0), at(right, 10));
    object.dims = Vec3(4, 2, 1.5);
    object.observations = {{0, 0}, {1, 0}};
    run.map.objects.push_back(object);
  }
  LoopClosure loop;
  loop.query_frame = 2;
  loop.decision = LoopDecision::kAccepted;
  loop.viewpoint_change_rad = M_PI;
  run.loops = {LoopClosure(), loop};
  return run;
}

}  // namespace sslcd
