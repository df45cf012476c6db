// SPDX-License-Identifier: BSD-3-Clause
#include "sim/halv_course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/dubins.h"
#include "sim/random.h"

namespace sslcd::sim {
namespace {

/// Where the pieces lead from a place and direction.
Path::Point Follow(const Path::Point& from, const std::vector<PathPiece>& pieces) {
  const Path::Point there = Path(pieces).At(LengthOf(pieces));
  const double sine = std::sin(from.heading), cosine = std::cos(from.heading);
  return {from.x + there.x * cosine + there.z * sine, from.z - there.x * sine + there.z * cosine,
          from.heading + there.heading};
}

TEST(ArcLineArc, LeadsThereAndIsNoDetour) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Path::Point from{random.Uniform(-20, 20), random.Uniform(-20, 20), random.Uniform(-4, 4)};
    const Path::Point to{random.Uniform(-20, 20), random.Uniform(-20, 20), random.Uniform(-4, 4)};
    const std::vector<PathPiece> pieces = ArcLineArc(from, to, 4);
    const Path::Point end = Follow(from, pieces);
    EXPECT_NEAR(end.x, to.x, 1e-6);
    EXPECT_NEAR(end.z, to.z, 1e-6);
    EXPECT_NEAR(WrapAngle(end.heading - to.heading), 0, 1e-6);
    const double straight = std::hypot(to.x - from.x, to.z - from.z);
    EXPECT_GE(LengthOf(pieces), straight - 1e-9);
    EXPECT_LE(LengthOf(pieces), straight + 4 * M_PI * 4);  // never more than two full turns
    for (const PathPiece& piece : pieces)
      EXPECT_LE(std::abs(piece.curvature_per_m), 1 / 4. + 1e-12);
  }
}

TEST(ArcLineArc, StraightOnIsALine) {
  EXPECT_NEAR(LengthOf(ArcLineArc({0, 0, 0}, {0, 10, 0}, 4)), 10, 1e-9);
  EXPECT_NEAR(LengthOf(ArcLineArc({1, 2, 3}, {1, 2, 3}, 4)), 0, 1e-9);
}

/// Every case meets its outward pass at the requested angle.
TEST(HalvCourse, MeetsItsWayOutAtTheGivenAngle) {
  for (int number = 1; number <= 4; ++number) {
    const HalvCase& shape = HalvCaseOf(number);
    for (int seed = 0; seed < 20; ++seed) {
      const HalvCourse course =
          MakeHalvCourse(shape, shape.viewpoint_low, shape.viewpoint_high, 1, seed);
      EXPECT_GE(course.viewpoint_rad, shape.viewpoint_low * M_PI / 180);
      EXPECT_LE(course.viewpoint_rad, shape.viewpoint_high * M_PI / 180);
      const Path::Point meet = course.path.At(shape.meet_m);
      // the rectangle turns into the way out just before
      const double short_of = std::max(0., -shape.after_m);
      const Path::Point again = course.path.At(course.last_leg_m + shape.before_m - short_of);
      EXPECT_LT(std::hypot(meet.x - again.x, meet.z - again.z), short_of + 2.) << number;
      if (shape.along_m > 0) {
        const Path::Point end = course.path.At(course.path.length());
        EXPECT_NEAR(std::abs(WrapAngle(end.heading - meet.heading)), M_PI, 1e-9);
        EXPECT_NEAR(end.x, meet.x, 1e-9);
      }
      EXPECT_NEAR(std::abs(WrapAngle(again.heading - meet.heading)), course.viewpoint_rad, 1e-9)
          << number;
      EXPECT_GT(course.path.length(), 110);
      EXPECT_LT(course.path.length(), 390);
    }
  }
}

TEST(HalvCourse, SizeStretchesIt) {
  const HalvCase& shape = HalvCaseOf(2);
  const double one = MakeHalvCourse(shape, 180, 180, 1, 1).path.length();
  const double two = MakeHalvCourse(shape, 180, 180, 2, 1).path.length();
  EXPECT_NEAR(two - one, 105 + 96, 12.);
}

}  // namespace
}  // namespace sslcd::sim
