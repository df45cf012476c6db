// SPDX-License-Identifier: BSD-3-Clause
#include "core/median.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

TEST(Median, IsTheOneInTheMiddle) {
  EXPECT_EQ(Median<double>({7}), 7);
  EXPECT_EQ(Median<double>({3, -1, 2}), 2);
  EXPECT_EQ(Median<float>({5, 5, 1, 5, 9}), 5);
}

TEST(Median, OfAnEvenNumberItIsTheUpperOne) {
  EXPECT_EQ(Median<double>({1, 2}), 2);
  EXPECT_EQ(Median<double>({4, 1, 3, 2}), 3);
}

TEST(Median, LeavesTheValuesAlone) {
  const std::vector<int> values = {3, 1, 2};
  EXPECT_EQ(Median(values), 2);
  EXPECT_EQ(values, (std::vector<int>{3, 1, 2}));
}

}  // namespace
}  // namespace sslcd
