// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_landmark.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

Sighting Of(const Vec3& dims, double range) {
  Sighting sighting;
  sighting.dims = dims;
  sighting.T_cam_object = Pose::Trans(Vec3(0, 0, range));
  return sighting;
}

TEST(FuseDims, OneSightingIsItself) {
  EXPECT_EQ(FuseDims({Of({4, 1.6, 1.5}, 20)}), Vec3(4, 1.6, 1.5));
}

TEST(FuseDims, OneWildSizeChangesLittle) {
  std::vector<Sighting> sightings(9, Of({4, 1.6, 1.5}, 20));
  sightings.push_back(Of({12, 3, 4}, 20));
  EXPECT_LT((FuseDims(sightings) - Vec3(4, 1.6, 1.5)).norm(), 0.05);
}

TEST(FuseDims, ASizeThatIsOffBy15PercentHasHalfTheWeight) {
  std::vector<Sighting> sightings(3, Of({4, 1.6, 1.5}, 20));
  sightings.push_back(Of({4.6, 1.6, 1.5}, 20));
  EXPECT_NEAR(FuseDims(sightings).x(), (3 * 4 + 0.5 * 4.6) / 3.5, 1e-9);
}

TEST(FuseDims, NearSightingsCountMore) {
  const Vec3 fused = FuseDims({Of({4.0, 1.6, 1.5}, 5), Of({4.2, 1.6, 1.5}, 60)});
  EXPECT_LT(fused.x(), 4.1);
  EXPECT_GT(fused.x(), 4.0);
}

TEST(VoteHeading, MajorityWins) {
  const auto heading = [](double yaw) { return Vec2(std::cos(yaw), std::sin(yaw)); };
  const Vec2 ahead = heading(0.3), nearly = heading(0.35), back = -ahead;
  EXPECT_NEAR(VoteHeading(0.3, {ahead, nearly, back}), 0.3, 1e-12);
  EXPECT_NEAR(VoteHeading(0.3, {ahead, -nearly, 5 * back}), 0.3 - M_PI, 1e-12);
  EXPECT_NEAR(VoteHeading(0.3, {}), 0.3, 1e-12);
}

}  // namespace
}  // namespace sslcd
