// SPDX-License-Identifier: BSD-3-Clause
// Places that look like the ones that the camera has seen, and are others: odometry tells.
#include <gtest/gtest.h>

#include "loop_drives.h"

namespace sslcd {
namespace {

// As of a good stereo camera: off by a metre or two after 500 m.
Drives WithGoodOdometry(sim::World world, std::uint64_t seed) {
  constexpr double kRangeM = 30, kHeadingRadPerSqrtM = 3e-4;
  return Drives(std::move(world), seed, kRangeM, kHeadingRadPerSqrtM);
}

void ExpectNoLoop(const Drives& drives) {
  const RunResult result = drives.Run();
  const SequenceMetrics metrics = drives.Judge(result);
  EXPECT_EQ(Accepted(result), 0);
  for (const LoopClosure& loop : result.loops)
    EXPECT_GT(1 - *loop.probability, LoopAcceptanceOptions().max_risk)
        << "refused by the graph alone";
  EXPECT_LT(metrics.ate, 1.05 * metrics.ate_odometry + 0.05);
  ExpectGoodRows(result);
}

// The objects along 150 m of a street, at the same places along a parallel one.
TEST(LookAlikes, ACopiedStreet60MetresAsideClosesNoLoop) {
  constexpr double kStreetM = 150, kAsideM = 60;
  const double turn_m = 0.5 * M_PI * kAsideM;
  for (const std::uint64_t seed : {1, 2}) {
    const sim::Path path({{kStreetM, 0}, {turn_m, 2 / kAsideM}, {kStreetM, 0}});
    sim::World world = EmptyWorld();
    Plant(path, kStreetM, 0.5, seed, world);
    const Pose T_street_copy = path.CameraAt(kStreetM + turn_m);
    ASSERT_NEAR(T_street_copy.translation().x(), kAsideM, 1e-6);
    for (std::size_t i = 0, originals = world.objects.size(); i < originals; ++i)
      Add(world.objects[i].label, T_street_copy * world.objects[i].T_world_object[0], world);
    Drive(path, 0, path.length(), world);
    ExpectNoLoop(WithGoodOdometry(std::move(world), seed));
  }
}

// Twice round a block, the second time on the storey above.
TEST(LookAlikes, TwoStoreys3MetresApartCloseNoLoop) {
  constexpr double kStoreyM = 3, kRampM = 40;
  for (const std::uint64_t seed : {1, 2}) {
    const sim::Path path = Block();
    sim::World world = EmptyWorld();
    Plant(path, path.length(), 0.5, seed, world);
    Drive(path, 0, 2 * path.length() - kRampM, world);
    // The ramp begins with the second lap. From there on only the upper storey's objects are seen.
    const int ramp = static_cast<int>(path.length() / kStep);
    for (std::size_t i = 0; i < world.truth.size(); ++i) {
      const double share = (static_cast<double>(i) - ramp) * kStep / kRampM;
      const double up_m = kStoreyM * std::min(1., std::max(0., share));
      world.truth.poses[i] = Pose::Trans(0, -up_m, 0) * world.truth.poses[i];
    }
    for (std::size_t i = 0, originals = world.objects.size(); i < originals; ++i) {
      world.objects[i].end_frame = ramp;
      Add(world.objects[i].label, Pose::Trans(0, -kStoreyM, 0) * world.objects[i].T_world_object[0],
          world);
      world.objects.back().first_frame = ramp;
    }
    ExpectNoLoop(WithGoodOdometry(std::move(world), seed));
  }
}

// The same drive on one level closes its loops.
TEST(LookAlikes, TheSamePlaceOnTheSameStoreyDoes) {
  const sim::Path path = Block();
  sim::World world = EmptyWorld();
  Plant(path, path.length(), 0.5, 1, world);
  Drive(path, 0, 2 * path.length() - 40, world);
  const Drives drives = WithGoodOdometry(std::move(world), 1);
  const RunResult result = drives.Run();
  EXPECT_GT(Accepted(result), 10);
  EXPECT_EQ(drives.Judge(result).wrong_loops, 0);
}

}  // namespace
}  // namespace sslcd
