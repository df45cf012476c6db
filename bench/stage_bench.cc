// SPDX-License-Identifier: BSD-3-Clause
// Times of the stages of a run: 500 keyframes, two and a half laps of 400 m around a block with 200
// cars and trees, frame by frame through a Mapper. Also the quality of the map before the final
// refinement. usage: stage_bench [REPEATS [SEED]]; prints the fastest repeat.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "eval/sequence_metrics.h"
#include "sim/path.h"
#include "sim/random.h"
#include "sim/sensor.h"
#include "sslcd/core/timing.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

// about 200 of them are visible and become landmarks
constexpr int kKeyframes = 500, kObjects = 275;
constexpr double kStep = 2.;  // from keyframe to keyframe [m]

sim::World Block(std::uint64_t seed) {
  constexpr double kRadius = 8;
  std::vector<sim::PathPiece> lap;
  for (int i = 0; i < 4; ++i) {
    lap.push_back({87.5, 0});
    lap.push_back({0.5 * M_PI * kRadius, 1 / kRadius});
  }
  const sim::Path path(lap, true);
  sim::World world;
  world.camera = {721.5377, 721.5377, 609.5593, 172.854, Vec3(0.06, 0, 0), 1242, 375};
  world.labels.Set("Car", {Symmetry::kNone});
  world.labels.Set("Tree", {Symmetry::kFull});
  sim::Random random(seed);
  for (int i = 0; i < kObjects; ++i) {
    const double s = path.length() * (i + random.Uniform(-0.3, 0.3)) / kObjects;
    const double right = random.Uniform(4, 10) * (i % 2 == 0 ? 1 : -1);
    if (random.Chance(0.5))
      world.objects.push_back({i, "Tree", Vec3(0.5, 0.5, 3), {path.ObjectAt(s, right, 0.1, 0)}});
    else
      world.objects.push_back(
          {i, "Car", Vec3(4.2, 1.7, 1.5), {path.ObjectAt(s, right, 0.9, random.Uniform(-.2, .2))}});
  }
  for (int i = 0; i < kKeyframes; ++i) {
    world.truth.stamps.push_back(0.3 * i);
    world.truth.poses.push_back(path.CameraAt(kStep * i));
  }
  return world;
}

void PrintStages(const TimingTable& timing) {
  for (const auto& [stage, times] : timing.Summary())
    std::printf("  %-22s %5d calls  p50 %7.2f  p95 %7.2f  max %7.2f ms\n", stage.c_str(),
                times.count, times.p50, times.p95, times.max);
}

void Measure(int repeats, std::uint64_t seed) {
  const sim::World world = Block(seed);
  sim::OdometryNoise drift;
  drift.heading_rad_per_sqrt_m = 4e-3;
  drift.scale_error = 0.01;
  sim::DetectorNoise detector;
  detector.max_range_m = 30;
  const sim::SimulatedDetections detections = sim::SimulateDetections(world, detector, seed);
  const Trajectory odometry = sim::SimulateOdometry(world.truth, drift, seed);
  const std::vector<Frame> frames = sim::MakeFrames(odometry, detections);
  const auto print_quality = [&](const Mapper& mapper, const char* when) {
    const SequenceMetrics m = ComputeSequenceMetrics(
        {mapper.CameraTrajectory().poses, odometry.poses, world.truth.poses, frames,
         detections.identity, mapper.LoopClosures(), mapper.Objects()});
    std::printf(
        "%s: ATE %.3f m (odometry %.2f), %d loops, %d wrong, recall %.2f, %d landmarks of %d "
        "objects\n",
        when, m.ate, m.ate_odometry, m.loops, m.wrong_loops, m.recall, m.landmarks,
        m.true_landmarks);
  };

  TimingTable fastest;
  double least_s = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    Mapper mapper({}, {world.gravity, world.labels, world.camera});
    const auto start = std::chrono::steady_clock::now();
    int keyframes = 0;
    for (const Frame& frame : frames) keyframes += mapper.AddFrame(frame).keyframe;
    if (i == 0) {
      std::printf("%d keyframes\n", keyframes);
      print_quality(mapper, "before Refine");
    }
    mapper.Refine();
    const double elapsed_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (i == 0) print_quality(mapper, "after Refine");
    if (elapsed_s > least_s) continue;
    least_s = elapsed_s;
    fastest = mapper.timing();
  }
  std::printf("fastest of %d runs: %.2f s\n", repeats, least_s);
  PrintStages(fastest);
}

}  // namespace
}  // namespace sslcd

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 10;
  const int seed = argc > 2 ? std::atoi(argv[2]) : 1;
  sslcd::Measure(repeats < 1 ? 1 : repeats, static_cast<std::uint64_t>(seed));
}
