// SPDX-License-Identifier: BSD-3-Clause
#include "loop/view_hull.h"

#include <gtest/gtest.h>

#include <cmath>

#include "layout_cases.h"

namespace sslcd {
namespace {

// An area of 10 m by 4 m.
ViewHull Rectangle() {
  return ViewHull({ObjectAt({0, 0, 0}), ObjectAt({10, 0, 3}), ObjectAt({10, 4, -3}),
                   ObjectAt({0, 4, 0}), ObjectAt({5, 2, 0})});
}

TEST(ViewHull, ContainsAMetreAroundTheObjects) {
  const ViewHull hull = Rectangle();
  for (const auto& [x, y] : {std::pair<double, double>{5, 2}, {-0.9, 2}, {10.9, 2}, {5, -0.9}})
    EXPECT_TRUE(hull.Contains(x, y)) << x << " " << y;
  for (const auto& [x, y] : {std::pair<double, double>{-1.1, 2}, {11.1, 2}, {5, -1.1}, {5, 5.1}})
    EXPECT_FALSE(hull.Contains(x, y)) << x << " " << y;
}

TEST(ViewHull, OfAStraightRowIsAStripe) {
  const ViewHull hull({ObjectAt({0, 0, 0}), ObjectAt({3, 3, 0}), ObjectAt({6, 6, 0})});
  const double beside = std::sqrt(0.5);  // a point at (beside, -beside) is 1 m beside the row
  EXPECT_TRUE(hull.Contains(3 + 0.9 * beside, 3 - 0.9 * beside));
  EXPECT_TRUE(hull.Contains(3 - 0.9 * beside, 3 + 0.9 * beside));
  EXPECT_FALSE(hull.Contains(3 + 1.1 * beside, 3 - 1.1 * beside));
  EXPECT_FALSE(hull.Contains(3 - 1.1 * beside, 3 + 1.1 * beside));
}

TEST(ViewHull, ItsBoxTurnsAndShiftsWithThePose) {
  const Eigen::AlignedBox2d box = Rectangle().BoxUnder({M_PI / 2, {100, 50, 7}});
  EXPECT_LT((box.min() - Vec2(95, 49)).norm(), 1e-12);
  EXPECT_LT((box.max() - Vec2(101, 61)).norm(), 1e-12);
}

TEST(ViewHull, FewerThanTwoObjectsSpanNoArea) {
  for (const ViewHull& hull : {ViewHull({}), ViewHull({ObjectAt({4, 5, 6})})}) {
    EXPECT_TRUE(hull.BoxUnder({0.3, {1, 2, 3}}).isEmpty());
    EXPECT_TRUE(hull.Contains(1000, -1000));
  }
}

}  // namespace
}  // namespace sslcd
