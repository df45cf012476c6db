// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_scene.h"

#include <algorithm>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr double kFarthest = 1e6;  // viewers compute in single precision [m]

RunScene::Path PathOf(const char* name, Colour colour, const Trajectory& trajectory) {
  RunScene::Path path{name, colour, {}};
  for (const Pose& pose : trajectory.poses) path.points.push_back(pose.translation());
  return path;
}

void AddObjects(const RunView& run, RunScene& scene) {
  const auto colours = LabelColours(run);
  for (const MapObject& object : run.map.objects)
    scene.objects.push_back({object.label + " " + std::to_string(object.id.value),
                             colours.at(object.label), IsRound(run, object.label), object});
  std::stable_sort(scene.objects.begin(), scene.objects.end(),
                   [](const auto& a, const auto& b) { return a.object.label < b.object.label; });
}

void AddLoops(const RunView& run, RunScene& scene) {
  const auto position = [&run](int frame) {
    return run.trajectory.poses[static_cast<std::size_t>(frame)].translation();
  };
  for (const LoopClosure& loop : AcceptedLoops(run))
    scene.loops.push_back(
        {"loop " + std::to_string(loop.query_frame) + " to " + std::to_string(loop.match_frame),
         ViewpointColour(loop.viewpoint_change_rad), position(loop.query_frame),
         position(loop.match_frame), loop});
}

void CheckExtent(const RunScene& scene, const std::string& folder) {
  const Vec3 origin = scene.T_world_first.translation();
  const auto check = [&](const std::string& name, double distance) {
    if (distance < kFarthest) return;
    throw Error(ErrorKind::kBadInput,
                folder + ": '" + name +
                    "' reaches farther than 1000 km from the first camera, where other programs "
                    "have no precision left: check the odometry ('sslcd_run check')");
  };
  for (const RunScene::Object& each : scene.objects)
    check(each.name,
          (each.object.T_world_object.translation() - origin).norm() + each.object.dims.norm());
  for (const RunScene::Path& path : scene.paths)
    for (const Vec3& point : path.points) check(path.name, (point - origin).norm());
}

}  // namespace

RunScene SceneOf(const RunView& run) {
  RequirePoses(run);
  RunScene scene;
  scene.name = run.record && !run.record->dataset.empty() ? run.record->dataset : "run";
  scene.gravity = run.gravity;
  scene.T_world_first = run.trajectory.poses[0];
  scene.paths = {PathOf("odometry", kOdometryColour, run.odometry),
                 PathOf("corrected trajectory", kTrajectoryColour, run.trajectory)};
  if (!run.truth.poses.empty())
    scene.paths.push_back(PathOf("ground truth", kTruthColour, run.truth));
  AddObjects(run, scene);
  AddLoops(run, scene);
  CheckExtent(scene, run.folder);
  return scene;
}

}  // namespace sslcd
