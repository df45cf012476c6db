// SPDX-License-Identifier: BSD-3-Clause
// Layout matching on the shared map pairs: labels and positions only, no prior pose.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "formats/pairs.h"
#include "layout_cases.h"

namespace sslcd {
namespace {

std::string PairsFile(const std::string& name) {
  const char* root = std::getenv("SSLCD_DATA_DIR");
  const std::filesystem::path beside =
      std::filesystem::path(__FILE__).parent_path() / "../../../shared/data";
  return (root != nullptr ? std::filesystem::path(root) : beside) / "object-pairs" / name;
}

Vec3 Centre(const std::vector<LayoutObject>& objects) {
  Vec3 centre = Vec3::Zero();
  for (const LayoutObject& object : objects)
    centre += object.position / static_cast<double>(objects.size());
  return centre;
}

struct Count {
  int right = 0, wrong = 0, refused = 0;
};

Count Judge(const std::vector<LayoutPair>& pairs, const std::string& scene) {
  Count count;
  for (const LayoutPair& pair : pairs) {
    if (pair.scene.rfind(scene, 0) != 0) continue;
    const LayoutAnswer answer = MatchLayouts(pair.local, pair.global);
    if (answer.decision != LoopDecision::kAccepted) {
      ++count.refused;
      continue;
    }
    const YawShift& pose = answer.hypotheses[0].pose;
    const Vec3 centre = Centre(pair.local);
    const bool right = (Apply(pose, centre) - Apply(pair.truth, centre)).head<2>().norm() < 1 &&
                       std::abs(WrapAngle(pose.yaw - pair.truth.yaw)) < 5 * M_PI / 180;
    ++(right ? count.right : count.wrong);
  }
  return count;
}

TEST(ObjectPairs, StreetsAndLots) {
  const std::string file = PairsFile("pairs_seed7.txt");
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "skipped: no data (object-pairs), set SSLCD_DATA_DIR";
  const std::vector<LayoutPair> pairs = ReadLayoutPairs(file);
  const Count street = Judge(pairs, "street"), lot = Judge(pairs, "lot");
  EXPECT_EQ(street.right + street.wrong + street.refused, 180);
  EXPECT_GE(street.right, 175);
  EXPECT_LE(street.wrong, 1);
  EXPECT_EQ(lot.right + lot.wrong + lot.refused, 180);
  EXPECT_GE(lot.right, 168);
  EXPECT_LE(lot.wrong, 1);
}

TEST(ObjectPairs, TwoScansOfOneRealPlace) {
  const std::string file = PairsFile("pair_kitti00_52_4501.txt");
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "skipped: no data (object-pairs), set SSLCD_DATA_DIR";
  const LayoutPair pair = ReadLayoutPairs(file).at(0);
  const LayoutAnswer answer = MatchLayouts(pair.local, pair.global);
  ASSERT_EQ(answer.decision, LoopDecision::kAccepted) << answer.reason;
  EXPECT_GT(answer.score, 10);
  const YawShift& pose = answer.hypotheses[0].pose;
  EXPECT_LT((pose.t - pair.truth.t).head<2>().norm(), 0.3);
  EXPECT_LT(std::abs(WrapAngle(pose.yaw - pair.truth.yaw)), M_PI / 180);
}

}  // namespace
}  // namespace sslcd
