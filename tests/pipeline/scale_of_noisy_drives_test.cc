// SPDX-License-Identifier: BSD-3-Clause
// Errors of detections that shrink the map: of the range, seen along a ray that the detection's own
// error turns, and of detections that join a neighbour. Both always make it smaller.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/halv.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

// Odometry whose scale is right; the detector has twice the noise of HALV-sim.
double LogScaleOf(int case_number, std::uint64_t seed) {
  sim::HalvOptions options;
  options.scene.case_number = case_number;
  options.drift.ate_m = 0;
  options.drift.shape.scale_error = options.drift.shape.wander_scale = 0;
  options.detector.scale *= 2;
  const sim::HalvSequence halv = sim::MakeHalv(seed, options);
  const sim::World& world = halv.scene.world;
  Mapper mapper(Options(), {world.gravity, world.labels, world.camera});
  for (const Frame& frame : sim::MakeFrames(halv.odometry, halv.detections)) mapper.AddFrame(frame);
  mapper.Refine();
  return std::log(mapper.scale());
}

TEST(NoisyDrives, HaveNearlyTheRightScale) {
  double sum = 0;
  for (const std::uint64_t seed : {500, 501})
    for (const int case_number : {1, 2}) sum += LogScaleOf(case_number, seed);
  EXPECT_NEAR(sum / 4, 0, 0.012);
}

}  // namespace
}  // namespace sslcd
