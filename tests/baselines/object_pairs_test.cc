// SPDX-License-Identifier: BSD-3-Clause
// The baselines on the shared map pairs. docs/baselines.md has the figures; here only that they do
// not get worse.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "baselines/options.h"
#include "formats/pairs.h"
#include "loop/layout_likelihood.h"
#include "temp_folder.h"

namespace sslcd::baselines {
namespace {

struct Count {
  int right = 0, wrong = 0;
};

// Right: within a metre at the centre of the local objects, and 5 degrees.
Count Judge(const std::vector<LayoutPair>& pairs, const std::string& scene,
            const LayoutMatcher& match) {
  Count count;
  for (const LayoutPair& pair : pairs) {
    if (pair.scene.rfind(scene, 0) != 0) continue;
    const auto answer = match(pair.local, pair.global);
    if (!answer || !answer->accepted) continue;
    Vec3 centre = Vec3::Zero();
    for (const LayoutObject& object : pair.local)
      centre += object.position / static_cast<double>(pair.local.size());
    const bool right =
        (Apply(answer->pose, centre) - Apply(pair.truth, centre)).head<2>().norm() < 1 &&
        std::abs(WrapAngle(answer->pose.yaw - pair.truth.yaw)) < 5 * M_PI / 180;
    ++(right ? count.right : count.wrong);
  }
  return count;
}

TEST(ObjectPairs, AsManyRightAsMeasured) {
  SSLCD_REAL_DATA(folder, "object-pairs");
  const std::vector<LayoutPair> pairs = ReadLayoutPairs(folder + "/pairs_seed7.txt");
  const BaselineOptions o;
  struct Case {
    std::string name;
    LayoutMatcher match;
    int street, lot;  // smallest numbers of correct answers of 180
  };
  const std::vector<Case> cases{
      {"lin", [&](const auto& l, const auto& g) { return MatchLin(l, g, o.lin); }, 120, 20},
      {"x_view", [&](const auto& l, const auto& g) { return MatchXView(l, g, o.x_view); }, 95, 55},
      {"semantic_histogram",
       [&](const auto& l, const auto& g) {
         return MatchSemanticHistogram(l, g, o.semantic_histogram);
       },
       15, 3}};
  for (const Case& c : cases) {
    const Count street = Judge(pairs, "street", c.match), lot = Judge(pairs, "lot", c.match);
    std::printf("%-20s street %d right, %d wrong; lot %d right, %d wrong\n", c.name.c_str(),
                street.right, street.wrong, lot.right, lot.wrong);
    EXPECT_GE(street.right, c.street) << c.name;
    EXPECT_GE(lot.right, c.lot) << c.name;
  }
}

}  // namespace
}  // namespace sslcd::baselines
