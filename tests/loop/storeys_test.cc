// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "layout_cases.h"

namespace sslcd {
namespace {

// The map has two storeys with the same objects; the local map was seen on the lower one.
struct TwoStoreys {
  std::vector<LayoutObject> map = Strewn(40, 40, 1), local;

  TwoStoreys(double storey_m, double altitude) {
    for (LayoutObject& object : map) object.altitude = 1;
    local = SeenFrom(map, YawShift{}, {0, 0}, 20, 0.1, 2);
    for (LayoutObject& object : map) object.altitude += storey_m;
    for (LayoutObject& object : local) object.altitude = altitude;
  }
  std::size_t Matches(double max_rise_m) const {
    const LayoutIndex index(map, 50, 2);
    return LayoutLikelihood(local, index, {}, MapLimits{max_rise_m}).Evaluate({}).matches.size();
  }
};

TEST(LayoutLikelihood, ObjectsOfAnotherStoreyDoNotMatch) {
  const TwoStoreys upper(3, 1), lower(0, 1), below(-3, 1);
  ASSERT_GT(lower.Matches(2), 10u);
  EXPECT_EQ(upper.Matches(2), 0u);
  EXPECT_EQ(below.Matches(2), 0u);
  EXPECT_EQ(upper.Matches(4), lower.Matches(2)) << "odometry of height is that uncertain";
  EXPECT_EQ(upper.Matches(std::numeric_limits<double>::infinity()), lower.Matches(2));
}

TEST(LayoutLikelihood, AnUnknownAltitudeIsNoLimit) {
  const TwoStoreys local(3, std::nan("")), known(0, 1);
  EXPECT_EQ(local.Matches(0), known.Matches(2));
  TwoStoreys map(3, 1);
  for (LayoutObject& object : map.map) object.altitude = LayoutObject().altitude;
  EXPECT_EQ(map.Matches(0), known.Matches(2));
}

}  // namespace
}  // namespace sslcd
