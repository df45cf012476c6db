// SPDX-License-Identifier: BSD-3-Clause
#include "eval/odometry_returns.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

const Vec3 kUp(0, -1, 0);

// Steps of 1 m from corner to corner, on the level z, x.
Trajectory Path(const std::vector<Vec3>& corners) {
  Trajectory path;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vec3 way = corners[i] - corners[i - 1];
    for (double m = i == 1 ? 0 : 1; m <= way.norm() + 1e-9; ++m) {
      path.stamps.push_back(static_cast<double>(path.size()));
      path.poses.push_back(Pose(lie::SO3<double>(), corners[i - 1] + way.normalized() * m));
    }
  }
  return path;
}

TEST(OdometryReturns, AStraightRoadHasNone) {
  const OdometryReturns returns = FindReturns(Path({{0, 0, 0}, {0, 0, 200}}), kUp);
  EXPECT_EQ(returns.stretches, 0);
  ASSERT_TRUE(returns.nearest);
  EXPECT_NEAR(returns.nearest->distance_m, 60, 1e-9);
  EXPECT_NEAR(returns.nearest->path_m, 60, 1e-9);
}

TEST(OdometryReturns, NoPathNoAnswer) {
  for (const Trajectory& path : {Trajectory(), Path({{0, 0, 0}, {0, 0, 59}})}) {
    const OdometryReturns returns = FindReturns(path, kUp);
    EXPECT_EQ(returns.stretches, 0);
    EXPECT_FALSE(returns.nearest);
  }
}

TEST(OdometryReturns, CountsEachStretchOnce) {
  // round a block of 100 m and 40 m of the first side again, 7 m beside it
  const OdometryReturns once = FindReturns(
      Path({{0, 0, 0}, {0, 0, 100}, {100, 0, 100}, {100, 0, 0}, {7, 0, 0}, {7, 0, 40}}), kUp);
  EXPECT_EQ(once.stretches, 1);
  EXPECT_NEAR(once.nearest->distance_m, 7, .4);
  // across the first side at 30 m and at 80 m
  const OdometryReturns twice = FindReturns(Path({{0, 0, 0},
                                                  {0, 0, 110},
                                                  {50, 0, 110},
                                                  {50, 0, 80},
                                                  {-50, 0, 80},
                                                  {-50, 0, 30},
                                                  {50, 0, 30}}),
                                            kUp);
  EXPECT_EQ(twice.stretches, 2);
}

TEST(OdometryReturns, TheRadiusIsHorizontal) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {0, 0, 100}, {9, 0, 100}, {9, 0, 50}};
  EXPECT_EQ(FindReturns(Path(corners), kUp).stretches, 1);
  EXPECT_EQ(FindReturns(Path(corners), kUp, {5, 8.9, 60}).stretches, 0);
  // a car park of two storeys: as far as odometry tells, this is a return
  std::vector<Vec3> above = corners;
  above[2].y() = above[3].y() = -20;
  EXPECT_EQ(FindReturns(Path(above), kUp).stretches, 1);
  EXPECT_EQ(FindReturns(Path(above), Vec3(1, 0, 0)).stretches, 0);
}

}  // namespace
}  // namespace sslcd
