// SPDX-License-Identifier: BSD-3-Clause
#include "core/math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sslcd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(LogSumExp, IsTheLogOfTheSum) {
  EXPECT_NEAR(LogSumExp({std::log(2.), std::log(3.), std::log(5.)}), std::log(10.), 1e-12);
  EXPECT_EQ(LogSumExp({-4}), -4);
}

TEST(LogSumExp, NeitherOverflowsNorUnderflows) {
  EXPECT_NEAR(LogSumExp({1000, 1000}), 1000 + std::log(2.), 1e-9);
  EXPECT_NEAR(LogSumExp({-1000, -1000}), -1000 + std::log(2.), 1e-9);
  EXPECT_EQ(LogSumExp({-kInfinity, 3}), 3);
  EXPECT_EQ(LogSumExp({kInfinity, 3}), kInfinity);
}

TEST(LogSumExp, OfNothingOrOfImpossibleThingsIsImpossible) {
  EXPECT_EQ(LogSumExp({}), -kInfinity);
  EXPECT_EQ(LogSumExp({-kInfinity, -kInfinity}), -kInfinity);
}

TEST(Chi2Quantile, MatchesTables) {
  EXPECT_NEAR(Chi2Quantile(0.99, 6), 16.812, 0.08);
  EXPECT_NEAR(Chi2Quantile(0.99, 4), 13.277, 0.07);
  EXPECT_NEAR(Chi2Quantile(0.99, 3), 11.345, 0.06);
  EXPECT_NEAR(Chi2Quantile(0.95, 6), 12.592, 0.06);
}

TEST(LogGamma, IsTheLogOfTheFactorialBefore) {
  EXPECT_NEAR(LogGamma(5), std::log(24.), 1e-14);
  EXPECT_NEAR(LogGamma(0.5), 0.5 * std::log(M_PI), 1e-14);
}

TEST(LogBetaBinomial, IsTheChanceOfASequenceOfUnknownRate) {
  EXPECT_NEAR(LogBetaBinomial(0, 0, 2, 3), 0, 1e-14);
  EXPECT_NEAR(LogBetaBinomial(1, 0, 2, 3), std::log(2. / 5), 1e-14);
  EXPECT_NEAR(LogBetaBinomial(1, 1, 2, 3), std::log(2. / 5 * 3 / 6), 1e-14);
}

}  // namespace
}  // namespace sslcd
