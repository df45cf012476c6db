// SPDX-License-Identifier: BSD-3-Clause
// Small worlds whose truth is known, and drives through them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "eval/sequence_metrics.h"
#include "sim/path.h"
#include "sim/random.h"
#include "sim/sensor.h"
#include "sslcd/pipeline/run.h"

namespace sslcd {

inline constexpr double kStep = 0.8;  // of the camera from frame to frame [m]

// Round a block, 330 m a lap.
inline sim::Path Block() {
  constexpr double kRadius = 8;
  const std::vector<sim::PathPiece> side{{70, 0}, {0.5 * M_PI * kRadius, 1 / kRadius}};
  std::vector<sim::PathPiece> lap;
  for (int i = 0; i < 4; ++i) lap.insert(lap.end(), side.begin(), side.end());
  return sim::Path(lap, true);
}

inline sim::World EmptyWorld() {
  sim::World world;
  world.camera = {721.5377, 721.5377, 609.5593, 172.854, Vec3(0.06, 0, 0), 1242, 375};
  world.labels.Set("Car", {Symmetry::kNone});
  world.labels.Set("Tree", {Symmetry::kFull});
  return world;
}

inline void Add(const std::string& label, const Pose& T_world_object, sim::World& world) {
  const Vec3 dims = label == "Car" ? Vec3(4.2, 1.7, 1.5) : Vec3(0.5, 0.5, 3.);
  world.objects.push_back({static_cast<int>(world.objects.size()), label, dims, {T_world_object}});
}

// Objects are on both sides of the path, `share_of_trees` of them trees, at distances that never
// repeat.
inline void Plant(const sim::Path& path, double length_m, double share_of_trees, std::uint64_t seed,
                  sim::World& world) {
  sim::Random random(seed);
  for (double s = 3; s < length_m - 3; s += random.Uniform(4, 14)) {
    const double right = random.Chance(0.5) ? random.Uniform(4, 10) : -random.Uniform(4, 10);
    const bool tree = random.Chance(share_of_trees);
    Add(tree ? "Tree" : "Car",
        path.ObjectAt(s, right, tree ? 0.1 : 0.9, tree ? 0. : random.Uniform(-0.2, 0.2)), world);
  }
}

// The camera goes from one point of the path to another, which may lie further back: then it looks
// that way.
inline void Drive(const sim::Path& path, double from_m, double to_m, sim::World& world) {
  const auto push = [&](const Pose& T_world_cam) {
    world.truth.stamps.push_back(0.1 * static_cast<double>(world.truth.size()));
    world.truth.poses.push_back(T_world_cam);
  };
  const double sign = to_m > from_m ? 1 : -1;
  for (double s = 0; s < std::abs(to_m - from_m); s += kStep)
    push(path.CameraAt(from_m + sign * s) *
         Pose(lie::SO3<double>::RotY(sign > 0 ? 0 : M_PI), Vec3::Zero()));
}

// Turns around in place.
inline void TurnRound(sim::World& world) {
  constexpr int kFrames = 20;
  const Pose T_world_cam = world.truth.poses.back();
  for (int i = 1; i <= kFrames; ++i) {
    world.truth.stamps.push_back(0.1 * static_cast<double>(world.truth.size()));
    world.truth.poses.push_back(T_world_cam *
                                Pose(lie::SO3<double>::RotY(i * M_PI / kFrames), Vec3::Zero()));
  }
}

// What a drive through a world looks like to the mapper, and what came of it.
struct Drives {
  sim::World world;
  std::vector<Frame> frames;
  std::vector<int> identities;

  Drives(sim::World w, std::uint64_t seed, double range_m = 30,
         double heading_rad_per_sqrt_m = 4e-3)
      : world(std::move(w)) {
    sim::OdometryNoise drift;
    drift.heading_rad_per_sqrt_m = heading_rad_per_sqrt_m;
    drift.scale_error = 0.01;
    sim::DetectorNoise detector;
    detector.max_range_m = range_m;
    const sim::SimulatedDetections detections = sim::SimulateDetections(world, detector, seed);
    frames = sim::MakeFrames(sim::SimulateOdometry(world.truth, drift, seed), detections);
    identities = detections.identity;
  }
  MapperContext Context() const { return {world.gravity, world.labels, world.camera}; }
  RunResult Run(const Options& options = {}) const {
    return RunSequence(frames, Context(), options);
  }
  SequenceMetrics Judge(const RunResult& result) const {
    return ComputeSequenceMetrics({result.trajectory.poses, result.odometry.poses,
                                   world.truth.poses, frames, identities, result.loops,
                                   result.objects});
  }
};

enum class SecondLap { kSame, kOpposite };

// Twice around the block. The camera passes its start before it turns around.
inline Drives TwoLaps(SecondLap second, double share_of_trees, std::uint64_t seed) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  Plant(path, path.length(), share_of_trees, seed, world);
  if (second == SecondLap::kSame) {
    Drive(path, 0, 2 * path.length(), world);
  } else {
    constexpr double kMore = 60;
    Drive(path, 0, path.length() + kMore, world);
    TurnRound(world);
    Drive(path, path.length() + kMore, 0, world);
  }
  return Drives(std::move(world), seed);
}

inline int Count(const RunResult& result, LoopDecision decision) {
  return static_cast<int>(
      std::count_if(result.loops.begin(), result.loops.end(),
                    [decision](const LoopClosure& loop) { return loop.decision == decision; }));
}

inline int Accepted(const RunResult& result) { return Count(result, LoopDecision::kAccepted); }

inline void ExpectGoodRows(const RunResult& result) {
  for (const LoopClosure& loop : result.loops) {
    EXPECT_FALSE(loop.reason.empty());
    EXPECT_LT(loop.match_frame, loop.query_frame);
    EXPECT_GE(loop.match_frame, 0);
    EXPECT_TRUE(std::isfinite(loop.score));
    EXPECT_TRUE(std::isfinite(loop.second_score));
    EXPECT_TRUE(std::isfinite(loop.T_match_query.Log().sum()));
    if (loop.decision != LoopDecision::kAccepted) continue;
    EXPECT_GE(loop.pairs.size(), 4u);
    EXPECT_GT(loop.covariance.diagonal().minCoeff(), 0);
  }
}

}  // namespace sslcd
