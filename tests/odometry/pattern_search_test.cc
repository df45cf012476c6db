// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/pattern_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace sslcd {
namespace {

TEST(MaximiseOverLogs, FindsTheMaximumOfAQuadratic) {
  for (const auto& [x, y] : {std::pair(0., 0.), {1.3, -2.6}, {-3.37, 0.41}}) {
    for (const double coupling : {0., 0.8, -0.8}) {
      const auto [found_x, found_y] = MaximiseOverLogs<2>([&, x = x, y = y](const auto& at) {
        const double dx = at[0] - x, dy = at[1] - y;
        return -dx * dx - dy * dy + 2 * coupling * dx * dy;
      });
      EXPECT_NEAR(found_x, x, 0.05);
      EXPECT_NEAR(found_y, y, 0.05);
    }
  }
}

TEST(MaximiseOverLogs, TheResultDoesNotDependOnTheStart) {
  const auto value = [](const std::array<double, 2>& at) {
    return -std::pow(at[0] - 1.3, 2) - std::pow(at[1] + 0.7, 2);
  };
  const auto from_zero = MaximiseOverLogs<2>(value);
  EXPECT_EQ(MaximiseOverLogs<2>(value, {4.17, -3.33}), from_zero);
  EXPECT_EQ(MaximiseOverLogs<2>(value, from_zero), from_zero);
}

TEST(MaximiseOverLogs, ANearStartIsQuicker) {
  int calls = 0;
  const auto value = [&](const std::array<double, 2>& at) {
    ++calls;
    return -std::pow(at[0] - 1.3, 2) - std::pow(at[1] + 0.7, 2);
  };
  MaximiseOverLogs<2>(value);
  const int from_zero = std::exchange(calls, 0);
  MaximiseOverLogs<2>(value, {1.4, -0.6});
  EXPECT_LT(calls, from_zero - 10);
}

TEST(MaximiseOverLogs, StaysAtZeroWhereNothingIsBetter) {
  const std::array<double, 2> zero{0, 0};
  EXPECT_EQ(MaximiseOverLogs<2>([](const auto&) { return 3.; }), zero);
  EXPECT_EQ(MaximiseOverLogs<2>([](const auto&) { return std::nan(""); }), zero);
  EXPECT_EQ(MaximiseOverLogs<2>([](const auto& at) {
              return at[0] == 0 && at[1] == 0 ? 0. : -std::numeric_limits<double>::infinity();
            }),
            zero);
}

}  // namespace
}  // namespace sslcd
