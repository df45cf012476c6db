// SPDX-License-Identifier: BSD-3-Clause
// Loop closure as a whole, on drives through small synthetic worlds whose truth is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "sim/path.h"
#include "sslcd/core/error.h"
#include "sslcd/eval/sequence_metrics.h"
#include "sslcd/io/run_folder.h"
#include "sslcd/pipeline/run.h"
#include "sslcd/sim/random.h"
#include "sslcd/sim/sensor.h"

namespace sslcd {
namespace {

constexpr double kStep = 0.8;  // of the camera from frame to frame [m]

// Round a block, 330 m a lap.
sim::Path Block() {
  constexpr double kRadius = 8;
  const std::vector<sim::PathPiece> side{{70, 0}, {0.5 * M_PI * kRadius, 1 / kRadius}};
  std::vector<sim::PathPiece> lap;
  for (int i = 0; i < 4; ++i) lap.insert(lap.end(), side.begin(), side.end());
  return sim::Path(lap, true);
}

sim::World EmptyWorld() {
  sim::World world;
  world.camera = {721.5377, 721.5377, 609.5593, 172.854, Vec3(0.06, 0, 0), 1242, 375};
  world.labels.Set("Car", {Symmetry::kNone});
  world.labels.Set("Tree", {Symmetry::kFull});
  return world;
}

void Add(const std::string& label, const Pose& T_world_object, sim::World& world) {
  const Vec3 dims = label == "Car" ? Vec3(4.2, 1.7, 1.5) : Vec3(0.5, 0.5, 3.);
  world.objects.push_back({static_cast<int>(world.objects.size()), label, dims, {T_world_object}});
}

// Things stand on both sides of the path, `share_of_trees` of them trees, at distances that never repeat.
void Plant(const sim::Path& path, double length_m, double share_of_trees, std::uint64_t seed, sim::World& world) {
  sim::Random random(seed);
  for (double s = 3; s < length_m - 3; s += random.Uniform(4, 14)) {
    const double right = random.Chance(0.5) ? random.Uniform(4, 10) : -random.Uniform(4, 10);
    const bool tree = random.Chance(share_of_trees);
    Add(tree ? "Tree" : "Car", path.ObjectAt(s, right, tree ? 0.1 : 0.9, tree ? 0. : random.Uniform(-0.2, 0.2)), world);
  }
}

// The camera goes from one point of the path to another, which may lie further back: then it looks that way.
void Drive(const sim::Path& path, double from_m, double to_m, sim::World& world) {
  const auto push = [&](const Pose& T_world_cam) {
    world.truth.stamps.push_back(0.1 * static_cast<double>(world.truth.size()));
    world.truth.poses.push_back(T_world_cam);
  };
  const double sign = to_m > from_m ? 1 : -1;
  for (double s = 0; s < std::abs(to_m - from_m); s += kStep)
    push(path.CameraAt(from_m + sign * s) * Pose(lie::SO3<double>::RotY(sign > 0 ? 0 : M_PI), Vec3::Zero()));
}

// ... and turns round where it stands.
void TurnRound(sim::World& world) {
  constexpr int kFrames = 20;
  const Pose T_world_cam = world.truth.poses.back();
  for (int i = 1; i <= kFrames; ++i) {
    world.truth.stamps.push_back(0.1 * static_cast<double>(world.truth.size()));
    world.truth.poses.push_back(T_world_cam * Pose(lie::SO3<double>::RotY(i * M_PI / kFrames), Vec3::Zero()));
  }
}

// What a drive through a world looks like to the mapper, and what came of it.
struct Drives {
  sim::World world;
  std::vector<Frame> frames;
  std::vector<int> identities;

  Drives(sim::World w, std::uint64_t seed) : world(std::move(w)) {
    sim::OdometryNoise drift;
    drift.heading_rad_per_sqrt_m = 4e-3;
    drift.scale_error = 0.01;
    sim::DetectorNoise detector;
    detector.max_range_m = 30;
    const sim::SimulatedDetections detections = sim::SimulateDetections(world, detector, seed);
    frames = sim::MakeFrames(sim::SimulateOdometry(world.truth, drift, seed), detections);
    identities = detections.identity;
  }
  MapperContext Context() const { return {world.gravity, world.labels, world.camera}; }
  RunResult Run(const Options& options = {}) const { return RunSequence(frames, Context(), options); }
  SequenceMetrics Judge(const RunResult& result) const {
    return ComputeSequenceMetrics({result.trajectory.poses, result.odometry.poses, world.truth.poses, frames,
                                   identities, result.loops, result.objects});
  }
};

enum class SecondLap { kSame, kOpposite };

Drives TwoLaps(SecondLap second, double share_of_trees, std::uint64_t seed) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  Plant(path, path.length(), share_of_trees, seed, world);
  Drive(path, 0, path.length(), world);
  if (second == SecondLap::kSame) {
    Drive(path, path.length(), 2 * path.length(), world);
  } else {
    TurnRound(world);
    Drive(path, path.length(), 0, world);
  }
  return Drives(std::move(world), seed);
}

int Accepted(const RunResult& result) {
  return static_cast<int>(std::count_if(result.loops.begin(), result.loops.end(), [](const LoopClosure& loop) {
    return loop.decision == LoopDecision::kAccepted;
  }));
}

class LoopClosing : public ::testing::TestWithParam<std::tuple<SecondLap, double, int>> {};

TEST_P(LoopClosing, CorrectsTheDriftOfTwoLaps) {
  const auto [second, share_of_trees, seed] = GetParam();
  const Drives drives = TwoLaps(second, share_of_trees, seed);
  const RunResult result = drives.Run();
  const SequenceMetrics metrics = drives.Judge(result);
  printf("ate %.2f of %.2f loops %d wrong %d recall %.2f bins %d %d %d %d lm/true %.3f purity %.3f attempts %zu true %d lm %d\n", metrics.ate, metrics.ate_odometry, metrics.loops, metrics.wrong_loops, metrics.recall,
  metrics.true_by_viewpoint[0],metrics.true_by_viewpoint[1],metrics.true_by_viewpoint[2],metrics.true_by_viewpoint[3], metrics.landmarks_per_true, metrics.purity, result.loops.size(), metrics.true_landmarks, metrics.landmarks);
  for (auto& l : result.loops) if (getenv("V")) printf("%d %d %s %s %.2f\n", l.query_frame, l.match_frame, ToString(l.decision), l.reason.c_str(), l.score);
}

INSTANTIATE_TEST_SUITE_P(CarsAndTrees, LoopClosing,
                         ::testing::Combine(::testing::Values(SecondLap::kSame, SecondLap::kOpposite),
                                            ::testing::Values(0.5, 1.), ::testing::Values(1, 2, 3)));

}  // namespace
}  // namespace sslcd
