// SPDX-License-Identifier: BSD-3-Clause
#include "ground/ground_patches.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

const Pose kMotion = Pose::Trans(0.1, 0, -0.2) * Pose::RotY(0.02);

std::vector<GroundPair> Pairs() {
  std::vector<GroundPair> pairs;
  for (int x = -4; x <= 4; ++x)
    for (int z = 4; z <= 10; ++z) pairs.push_back({kMotion * Vec3(x, 0, z), Vec3(x, 0, z)});
  return pairs;
}

TEST(FitMotion, IsExactWithoutNoise) {
  std::vector<GroundPair> pairs = Pairs();
  const std::size_t count = pairs.size();
  EXPECT_LT((kMotion.inverse() * FitMotion(pairs)).Log().norm(), 1e-9);
  EXPECT_EQ(pairs.size(), count);
}

TEST(FitMotion, DropsWhatDoesNotAgree) {
  std::vector<GroundPair> pairs = Pairs();
  const std::size_t count = pairs.size();
  for (std::size_t i = 0; i < count; i += 3) pairs[i].in_b += Vec3(0.12, 0, (i % 2) ? 0.15 : -0.09);
  EXPECT_LT((kMotion.inverse() * FitMotion(pairs)).Log().norm(), 5e-3);
  EXPECT_EQ(pairs.size(), count - (count + 2) / 3);
}

TEST(FitMotion, OnePairGivesAShift) {
  std::vector<GroundPair> pairs{{Vec3(1, 0, 5), Vec3(0.9, 0, 5.1)}};
  EXPECT_LT((FitMotion(pairs).inverse() * Pose::Trans(0.1, 0, -0.1)).Log().norm(), 1e-12);
}

TEST(OnGround, KeepsShiftAndHeading) {
  EXPECT_LT((OnGround(kMotion).inverse() * kMotion).Log().norm(), 1e-12);
  const Pose tilted = kMotion * Pose::RotX(0.1) * Pose::Trans(0, 0.3, 0);
  const Pose flat = OnGround(tilted);
  EXPECT_EQ(flat.translation().y(), 0);
  EXPECT_NEAR((flat.so3() * Vec3(Vec3::UnitY())).y(), 1, 1e-12);
  EXPECT_NEAR(flat.so3().Log().y(), 0.02, 1e-9);
}

}  // namespace
}  // namespace sslcd
