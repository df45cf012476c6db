// SPDX-License-Identifier: BSD-3-Clause
#include "sim/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd::sim {
namespace {

TEST(Random, IsTheSameEverywhere) {
  Random random(42);
  // first output of mt19937_64(42), shifted
  EXPECT_DOUBLE_EQ(random.Uniform(), 0.75515553295453897);
}

TEST(Random, SameSeedSameNumbers) {
  Random a(7), b(7), c(8);
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    const double value = a.Normal();
    EXPECT_EQ(value, b.Normal());
    differs |= value != c.Normal();
  }
  EXPECT_TRUE(differs);
}

TEST(Random, HasTheRightMoments) {
  Random random(1);
  constexpr int kCount = 200000;
  double sum = 0, squares = 0, fourth = 0, uniform = 0, poisson = 0, poisson_squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.Normal(), u = random.Uniform(2, 4);
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    ASSERT_TRUE(u >= 2 && u < 4);
    uniform += u;
    const int n = random.Poisson(1.5);
    poisson += n;
    poisson_squares += n * n;
  }
  EXPECT_NEAR(sum / kCount, 0, 0.01);
  EXPECT_NEAR(squares / kCount, 1, 0.02);
  EXPECT_NEAR(fourth / kCount, 3, 0.1);
  EXPECT_NEAR(uniform / kCount, 3, 0.01);
  EXPECT_NEAR(poisson / kCount, 1.5, 0.02);
  EXPECT_NEAR(poisson_squares / kCount - std::pow(poisson / kCount, 2), 1.5, 0.04);
}

TEST(Random, Extremes) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(random.Chance(0));
    EXPECT_TRUE(random.Chance(1));
    EXPECT_EQ(random.Poisson(0), 0);
    EXPECT_EQ(random.Poisson(-1), 0);
  }
}

}  // namespace
}  // namespace sslcd::sim
