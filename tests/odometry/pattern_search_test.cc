// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/pattern_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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
