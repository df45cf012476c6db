// SPDX-License-Identifier: BSD-3-Clause
#include "loop/heading_density.h"

#include <gtest/gtest.h>

#include <cmath>

#include "layout_cases.h"

namespace sslcd {
namespace {

constexpr double kDegree = M_PI / 180;

TEST(HeadingDensity, IntegratesToOne) {
  for (const Symmetry symmetry : {Symmetry::kNone, Symmetry::kPi}) {
    double sum = 0;
    for (const double density : HeadingDensities(symmetry)) sum += density * kDegree;
    EXPECT_NEAR(sum, 1, 0.01);
  }
}

TEST(HeadingDensity, IsNextToNormalOf15Degrees) {
  const auto density = [](double angle) { return HeadingDensity(angle, Symmetry::kNone); };
  for (const double sigmas : {0.5, 1., 1.5}) {
    EXPECT_NEAR(density(sigmas * 14.5 * kDegree) / density(0), std::exp(-0.5 * sigmas * sigmas),
                0.02);
    EXPECT_EQ(density(sigmas), density(-sigmas));
  }
}

TEST(HeadingDensity, OneOfTenIsAnyHeadingAndOneOfTwentyReversed) {
  const auto density = [](double angle) { return HeadingDensity(angle, Symmetry::kNone); };
  const double any = 0.1 / (2 * M_PI);
  EXPECT_NEAR(density(M_PI / 2), any, 1e-5);
  EXPECT_NEAR((density(M_PI) - any) / (density(0) - any), 0.05 / 0.95, 1e-9);
}

TEST(HeadingDensity, WhatIsAlikeInFrontAndBehindIsReversedAsOftenAsNot) {
  for (const double angle : {0., 0.4, 1.5, 3.})
    EXPECT_NEAR(HeadingDensity(angle, Symmetry::kPi), HeadingDensity(angle + M_PI, Symmetry::kPi),
                1e-12);
}

TEST(ChanceHeadings, AreThoseOfTheMapUnderTheCommonTurnThatSuitsThemBest) {
  const auto density = [](double degrees) {
    return HeadingDensity(degrees * kDegree, Symmetry::kNone);
  };
  LayoutCounts::Headings map{};
  map[0][0] = 3;
  map[0][90] = 1;
  const double any = 1 / (2 * M_PI);
  const double along_x = std::log((3 * density(0) + density(90) + any) / 5),
               along_y = std::log((density(0) + 3 * density(90) + any) / 5);
  for (const double turn : {0., 25., 180., -95.}) {  // multiples of its bins
    std::vector<LayoutObject> local(5, ObjectAt({0, 0, 0}));
    for (LayoutObject& object : local) object.yaw = turn * kDegree;
    local[3].yaw += M_PI / 2;
    local[4].yaw = std::nan("");
    const std::vector<double> chance = ChanceHeadings(local, map);
    ASSERT_EQ(chance.size(), 5u);
    for (const int i : {0, 1, 2}) EXPECT_NEAR(chance[i], along_x, 1e-9) << turn;
    EXPECT_NEAR(chance[3], along_y, 1e-9);
    EXPECT_EQ(chance[4], 0) << "it has none";
    for (const double alone : ChanceHeadings({local[3]}, map)) EXPECT_NEAR(alone, along_x, 1e-9);
  }
}

TEST(ChanceHeadings, AMapWithoutHeadingsHasAny) {
  LayoutObject car = ObjectAt({0, 0, 0});
  car.yaw = 1;
  for (const double chance : ChanceHeadings({car, car}, {}))
    EXPECT_NEAR(chance, -std::log(2 * M_PI), 1e-12);
}

}  // namespace
}  // namespace sslcd
