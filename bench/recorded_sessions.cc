// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_sessions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/halv.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

// The cars before or after the change; driving ones are there both times. Backward: the way back.
sim::World WorldAt(const sim::World& all, bool after) {
  sim::World world = all;
  const int frames = static_cast<int>(all.truth.size());
  for (sim::WorldObject& object : world.objects) {
    const bool there =
        object.driving() || (after ? object.end_frame > frames : object.first_frame == 0);
    object.first_frame = there ? 0 : frames;
    object.end_frame = there ? std::numeric_limits<int>::max() : frames;
    if (after) std::reverse(object.T_world_object.begin(), object.T_world_object.end());
  }
  if (!after) return world;
  std::reverse(world.truth.poses.begin(), world.truth.poses.end());
  for (Pose& pose : world.truth.poses) pose = pose * Pose::RotY(M_PI);
  return world;
}

// `looks`: seed of the looks of the cars.
Session Record(const sim::World& world, int halv_case, std::uint64_t seed, std::uint64_t looks) {
  const sim::HalvDrift drift;
  const Trajectory odometry =
      sim::SimulateOdometryWithAte(world.truth, drift.shape, sim::HalvAte(halv_case),
                                   drift.ate_spread, seed)
          .odometry;
  sim::SimulatedDetections detections = sim::SimulateDetections(world, sim::HalvDetector(), seed);
  sim::AddAppearance(world, {}, looks, detections);
  return {sim::MakeFrames(odometry, detections), world.truth.poses};
}

}  // namespace

std::vector<double> PathOf(const Session& session) {
  std::vector<double> path_m{0};
  for (std::size_t i = 1; i < session.frames.size(); ++i)
    path_m.push_back(path_m.back() + (session.frames[i].T_odom_cam.translation() -
                                      session.frames[i - 1].T_odom_cam.translation())
                                         .norm());
  return path_m;
}

Session WithTruth(const Dataset& data) {
  if (!data.groundtruth || data.groundtruth->stamps.empty())
    throw Error(ErrorKind::kUsage, data.name + ": no ground truth");
  Session session;
  session.frames = data.frames;
  const std::vector<double>& stamps = data.groundtruth->stamps;
  for (const Frame& frame : data.frames) {
    const auto nearest = std::min_element(stamps.begin(), stamps.end(), [&](double a, double b) {
      return std::abs(a - frame.stamp) < std::abs(b - frame.stamp);
    });
    session.truth.push_back(data.groundtruth->poses[nearest - stamps.begin()]);
  }
  return session;
}

TwoVisits RecordHalvTwice(int halv_case, const std::string& layout, std::uint64_t seed,
                          double churn) {
  constexpr std::uint64_t kAgain = 1000, kCopy = 500;  // other seeds
  sim::HalvScene scene;
  scene.case_number = halv_case;
  scene.layout = layout;
  scene.churn = churn;
  const sim::World all = sim::MakeHalvWorld(seed, scene).world;
  const sim::World before = WorldAt(all, false);
  TwoVisits visits{all.gravity,
                   all.labels,
                   all.camera,
                   Record(before, halv_case, seed, seed),
                   Record(before, halv_case, seed + kCopy, seed + kCopy),
                   Record(WorldAt(all, true), halv_case, seed + kAgain, seed)};
  visits.copy.copy = true;
  return visits;
}

void StartUpright(const Vec3& up, const Pose& first_of_drive, Session& session) {
  const Vec3 up_in_cam = first_of_drive.so3().inverse() * up;
  const Vec3 now = session.frames.front().T_odom_cam.so3() * up_in_cam;
  const Vec3 axis = now.cross(up);
  if (axis.norm() < 1e-9) return;
  const auto turn =
      lie::SO3<double>::Exp(Vec3(std::atan2(axis.norm(), now.dot(up)) * axis.normalized()));
  for (Frame& frame : session.frames)
    frame.T_odom_cam = Pose(turn, Vec3::Zero()) * frame.T_odom_cam;
}

}  // namespace sslcd
