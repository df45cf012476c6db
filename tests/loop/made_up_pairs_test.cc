// SPDX-License-Identifier: BSD-3-Clause
// Layout matching on the map pairs of tests/data, which every copy of the repository has: labels
// and positions only, no prior pose.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "formats/pairs.h"
#include "layout_cases.h"

namespace sslcd {
namespace {

std::vector<LayoutPair> Pairs(const std::string& scene) {
  const std::filesystem::path tests = std::filesystem::path(__FILE__).parent_path().parent_path();
  std::vector<LayoutPair> chosen;
  for (const LayoutPair& pair : ReadLayoutPairs((tests / "data/object_pairs.txt").string()))
    if (pair.scene.rfind(scene, 0) == 0) chosen.push_back(pair);
  return chosen;
}

TEST(MadeUpPairs, WhatIsInTheMapIsFoundWhereItIs) {
  const std::vector<LayoutPair> pairs = Pairs("present/");
  ASSERT_EQ(pairs.size(), 32u);
  int right = 0, wrong = 0;
  for (const LayoutPair& pair : pairs) {
    const LayoutAnswer answer = MatchLayouts(pair.local, pair.global);
    if (answer.decision != LoopDecision::kAccepted) continue;
    const YawShift& pose = answer.hypotheses[0].pose;
    const bool is_right = ShiftBetween(pose, pair.truth, pair.local[0].position) < 1 &&
                          std::abs(WrapAngle(pose.yaw - pair.truth.yaw)) < 5 * M_PI / 180;
    ++(is_right ? right : wrong);
  }
  EXPECT_GE(right, 31) << "32 when the data was made";
  EXPECT_EQ(wrong, 0);
}

// Two lots of parking spaces alike are the one case that a layout alone does not always refuse;
// from 5 nats on it does (see DecisionOptions).
TEST(MadeUpPairs, WhatIsInAnotherWorldIsRefused) {
  const std::vector<LayoutPair> pairs = Pairs("absent/");
  ASSERT_EQ(pairs.size(), 8u);
  int accepted = 0;
  for (const LayoutPair& pair : pairs) {
    const LayoutAnswer answer = MatchLayouts(pair.local, pair.global);
    EXPECT_LT(answer.score, 5) << "pair " << pair.id;
    if (answer.decision != LoopDecision::kAccepted) continue;
    ++accepted;
    EXPECT_EQ(pair.scene, "absent/lot");
  }
  EXPECT_LE(accepted, 2) << "2 when the data was made";
}

}  // namespace
}  // namespace sslcd
