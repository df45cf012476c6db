// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/jet.h>
#include <gtest/gtest.h>
#include <lie/stumpff.h>

#include <cmath>
#include <vector>

namespace {

using Jet = ceres::Jet<double, 1>;

const std::vector<double> kSquares = {0,         1e-300, 1e-24, 1e-16, 1e-6,     0.3,  1.0, 1.99,
                                      2 - 1e-12, 2.0,    2.01,  4.0,   9.869604, 15.0, 39.0};

/// The definition, summed in long double.
double Series(int k, double s) {
  long double term = 1;
  for (int i = 2; i <= k; ++i) term /= i;
  long double sum = 0;
  for (int j = 0; j < 60; ++j) {
    sum += term;
    term *= -static_cast<long double>(s) / ((k + 2 * j + 1) * (k + 2 * j + 2));
  }
  return static_cast<double>(sum);
}

TEST(Stumpff, MatchesItsSeries) {
  for (double s : kSquares) {
    const auto c = lie::EvaluateStumpff(s);
    const double values[] = {c.c0, c.c1, c.c2, c.c3, c.c4, c.c5};
    double scale = 1;  // c_k(0)
    for (int k = 0; k < 6; ++k) {
      if (k > 1) scale /= k;
      EXPECT_TRUE(std::abs(values[k] - Series(k, s)) <= 3e-14 * scale) << "c" << k << " at " << s;
    }
  }
}

// d c_k / ds = (k c_{k+2} - c_{k+1}) / 2, from the series.
TEST(Stumpff, DerivativesOfDualNumbers) {
  for (double s : kSquares) {
    const auto c = lie::EvaluateStumpff(Jet(s, 0));
    const Jet values[] = {c.c0, c.c1, c.c2, c.c3, c.c4, c.c5};
    double scale = 1;
    for (int k = 0; k < 6; ++k) {
      if (k > 1) scale /= k;
      const double expected = (k * Series(k + 2, s) - Series(k + 1, s)) / 2;
      EXPECT_TRUE(std::abs(values[k].v[0] - expected) <= 1e-13 * scale) << "c" << k << "' at " << s;
    }
  }
}

TEST(AtanOverX, ValueAndDerivative) {
  EXPECT_EQ(lie::AtanOverX(0.0), 1.0);
  EXPECT_EQ(lie::AtanOverX(Jet(0.0, 0)).v[0], -1.0 / 3.0);
  for (double x : {1e-8, 1e-3, 0.05, 0.1, 0.2}) {
    const Jet y = lie::AtanOverX(Jet(x * x, 0));
    EXPECT_TRUE(std::abs(y.a - std::atan(x) / x) <= 4e-16);
    if (x < 0.01) continue;  // the quotient below cancels
    const double by_x = (x / (1 + x * x) - std::atan(x)) / (x * x);
    EXPECT_TRUE(std::abs(y.v[0] - by_x / (2 * x)) <= 1e-11);
  }
}

}  // namespace
