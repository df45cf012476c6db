// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "layout_cases.h"
#include "loop/layout_likelihood.h"

namespace sslcd {
namespace {

std::vector<LayoutObject> Square() {
  return {ObjectAt({0, 0, 0}), ObjectAt({10, 0, 0}), ObjectAt({0, 10, 0}), ObjectAt({10, 10, 0})};
}

// As if the later objects did not exist; their density stays.
TEST(LayoutLikelihood, OfAnEarlierMapIgnoresLaterObjects) {
  std::vector<LayoutObject> map = Square();
  for (LayoutObject& object : map) object.since_m = 10;
  for (int i = 0; i < 5; ++i) {
    map.push_back(ObjectAt({2. + 1.5 * i, 5.5, 0}));
    map.back().since_m = 60;
  }
  const LayoutIndex index(map, 50, 2);
  std::vector<LayoutObject> local = Square();
  local.push_back(map.back());
  const LayoutLikelihood now(local, index, {}), then = now.Of(local, 60);
  EXPECT_EQ(now.Evaluate({}).should_see, 9);
  EXPECT_EQ(now.Evaluate({}).matches.size(), 5u);
  EXPECT_EQ(then.Evaluate({}).should_see, 4);
  EXPECT_EQ(then.Evaluate({}).matches.size(), 4u);
  EXPECT_EQ(now.Of(local, 10).Evaluate({}).matches.size(), 0u);
}

}  // namespace
}  // namespace sslcd
