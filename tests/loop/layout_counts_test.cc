// SPDX-License-Identifier: BSD-3-Clause
#include "loop/layout_counts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "layout_cases.h"

namespace sslcd {
namespace {

LayoutObject Facing(double yaw, Symmetry symmetry) {
  LayoutObject object = ObjectAt({1, 2, 3}, 4);
  object.yaw = yaw;
  object.symmetry = symmetry;
  return object;
}

TEST(LayoutCounts, HeadingsAreRoundedToDegrees) {
  constexpr double kDegree = M_PI / 180;
  LayoutCounts counts;
  counts.Count(Facing(-0.4 * kDegree, Symmetry::kNone), 1);
  counts.Count(Facing(0.4 * kDegree, Symmetry::kNone), 1);
  counts.Count(Facing(89.6 * kDegree, Symmetry::kPi), 1);
  counts.Count(Facing(-1.2 * kDegree + 4 * M_PI, Symmetry::kNone), 1);
  LayoutCounts::Headings expected{};
  expected[0][0] = 2;
  expected[0][359] = 1;
  expected[1][90] = 1;
  EXPECT_EQ(counts.headings, expected);
}

TEST(LayoutCounts, RoundObjectsAndUnknownHeadingsCountByLabelOnly) {
  LayoutCounts counts;
  counts.Count(Facing(1, Symmetry::kFull), 1);
  counts.Count(Facing(std::nan(""), Symmetry::kNone), 1);
  EXPECT_EQ(counts.labels, (std::map<int, int>{{4, 2}}));
  EXPECT_EQ(counts.headings, LayoutCounts::Headings{});
}

TEST(LayoutCounts, RemovingAllLeavesNothing) {
  LayoutCounts counts;
  const LayoutObject object = Facing(1, Symmetry::kNone), other = ObjectAt({0, 0, 0}, 7);
  for (const int by : {1, 1, -1}) counts.Count(object, by);
  counts.Count(other, 1);
  EXPECT_EQ(counts.labels, (std::map<int, int>{{4, 1}, {7, 1}}));
  counts.Count(object, -1);
  counts.Count(other, -1);
  EXPECT_TRUE(counts.labels.empty());
  EXPECT_EQ(counts.headings, LayoutCounts::Headings{});
}

}  // namespace
}  // namespace sslcd
