// SPDX-License-Identifier: BSD-3-Clause
#include "eval/wilson.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

TEST(WilsonTest, EqualsPublishedValues) {
  // Newcombe, Statistics in Medicine 17 (1998), table I, method 3.
  struct Case {
    int successes, trials;
    double low, high;
  };
  for (const Case& c : {Case{81, 263, 0.2553, 0.3662}, Case{15, 148, 0.0624, 0.1605},
                        Case{0, 20, 0., 0.1611}, Case{1, 29, 0.0061, 0.1718}}) {
    const Interval interval = WilsonInterval(c.successes, c.trials);
    EXPECT_NEAR(interval.low, c.low, 5e-5);
    EXPECT_NEAR(interval.high, c.high, 5e-5);
  }
}

TEST(WilsonTest, HoldsTheRateAndIsSymmetric) {
  for (int n = 1; n < 60; ++n) {
    for (int k = 0; k <= n; ++k) {
      const Interval interval = WilsonInterval(k, n), mirrored = WilsonInterval(n - k, n);
      const double rate = static_cast<double>(k) / n;
      EXPECT_LE(0, interval.low);
      EXPECT_LE(interval.low, rate);
      EXPECT_GE(interval.high, rate);
      EXPECT_LE(interval.high, 1);
      EXPECT_NEAR(interval.low, 1 - mirrored.high, 1e-12);
      EXPECT_NEAR(WilsonInterval(k, n, 0.).low, rate, 1e-12);
      if (k < n) {
        // The ends solve |p - rate| = z sqrt(p (1-p) / n).
        const double p = interval.high;
        EXPECT_NEAR(p - rate, 1.959963984540054 * std::sqrt(p * (1 - p) / n), 1e-12);
      }
    }
  }
}

TEST(WilsonTest, NoTrialsAndNonsense) {
  EXPECT_EQ(WilsonInterval(0, 0).low, 0);
  EXPECT_EQ(WilsonInterval(0, 0).high, 1);
  EXPECT_THROW(WilsonInterval(-1, 5), Error);
  EXPECT_THROW(WilsonInterval(6, 5), Error);
  EXPECT_THROW(WilsonInterval(0, -1), Error);
  EXPECT_THROW(WilsonInterval(1, 5, -1.), Error);
  EXPECT_THROW(WilsonInterval(1, 5, std::nan("")), Error);
}

}  // namespace
}  // namespace sslcd
