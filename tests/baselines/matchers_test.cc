// SPDX-License-Identifier: BSD-3-Clause
// What holds for every baseline.
#include <gtest/gtest.h>

#include "baseline_cases.h"
#include "baselines/options.h"

namespace sslcd::baselines {
namespace {

using Objects = std::vector<LayoutObject>;

LayoutMatcher Matcher(const std::string& name, const BaselineOptions& options = {}) {
  if (name == "lin")
    return [=](const auto& l, const auto& g) { return MatchLin(l, g, options.lin); };
  if (name == "x_view")
    return [=](const auto& l, const auto& g) { return MatchXView(l, g, options.x_view); };
  return [=](const auto& l, const auto& g) {
    return MatchSemanticHistogram(l, g, options.semantic_histogram);
  };
}

class Baseline : public testing::TestWithParam<const char*> {
 protected:
  const LayoutMatcher match = Matcher(GetParam());
  const Objects global = Strewn(60, 60, 20, 5);  // distinctive: 20 labels
  const YawShift pose{-2.5, Vec3(30, -10, 0.3)};
  const Objects local = SeenFrom(global, pose, Vec2(30, 30), 20, 0.2);
};

TEST_P(Baseline, FindsAPlantedLayout) {
  ASSERT_GE(local.size(), 12u);
  const auto answer = match(local, global);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->accepted);
  EXPECT_GT(answer->score, 0);
  EXPECT_NEAR(std::remainder(answer->pose.yaw - pose.yaw, 2 * M_PI), 0, 0.03);
  const Vec3 centre = Apply(pose, Vec3::Zero());
  EXPECT_LT((Apply(answer->pose, Vec3::Zero()) - centre).norm(), 1);
  EXPECT_GE(answer->matches.size(), 5u);
  for (const auto& [l, g] : answer->matches) {
    EXPECT_EQ(local[l].label, global[g].label);
    EXPECT_LT((Apply(answer->pose, local[l].position) - global[g].position).norm(), 2);
  }
}

TEST_P(Baseline, ScoresAnotherPlaceLower) {
  const auto here = match(local, global), elsewhere = match(local, Strewn(60, 60, 20, 6));
  ASSERT_TRUE(here);
  EXPECT_LT(elsewhere ? elsewhere->score : 0, 0.5 * here->score);
}

TEST_P(Baseline, SameAnswerEachTime) {
  const auto one = match(local, global), other = match(local, global);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->matches, other->matches);
  EXPECT_EQ(one->score, other->score);
  EXPECT_EQ(one->pose.yaw, other->pose.yaw);
  EXPECT_EQ(one->pose.t, other->pose.t);
}

TEST_P(Baseline, TooFewObjects) {
  const Objects one{At(0, 0, 1)}, two{At(0, 0, 1), At(5, 0, 2)};
  EXPECT_FALSE(match({}, {}));
  EXPECT_FALSE(match({}, global));
  EXPECT_FALSE(match(local, {}));
  EXPECT_FALSE(match(one, global));
  EXPECT_FALSE(match(global, one));
  EXPECT_FALSE(match(two, global));
  EXPECT_FALSE(match(two, two));
}

TEST_P(Baseline, OddGeometry) {
  Objects row, heap, broken = global;
  for (int i = 0; i < 12; ++i) row.push_back(At(i * (6 + 0.3 * i), 0, i));
  for (int i = 0; i < 12; ++i) heap.push_back(At(1, 1, 0));
  for (LayoutObject& object : broken) object.position.x() = kNaN;
  const auto in_row = match(row, row);
  ASSERT_TRUE(in_row);
  EXPECT_NEAR(in_row->pose.yaw, 0, 0.01);
  EXPECT_FALSE(match(heap, heap));
  EXPECT_FALSE(match(broken, global));
  EXPECT_FALSE(match(local, broken));
}

TEST_P(Baseline, NothingTellsEqualLabelsApart) {
  Objects equal = global;
  for (LayoutObject& object : equal) object.label = 0;
  const Objects part = SeenFrom(equal, pose, Vec2(30, 30), 20, 0.2);
  // found or not: no crash, and a pose has matches that agree with it
  const auto answer = match(part, equal);
  if (!answer) return;
  for (const auto& [l, g] : answer->matches)
    EXPECT_LT((Apply(answer->pose, part[l].position) - equal[g].position).norm(), 2);
}

TEST_P(Baseline, DuplicatesAreMatchedOnce) {
  Objects twice = global;
  twice.insert(twice.end(), global.begin(), global.end());
  const auto answer = match(local, twice);
  if (!answer) return;
  std::vector<bool> taken(twice.size());
  for (const auto& [l, g] : answer->matches) {
    EXPECT_FALSE(taken[g]);
    taken[g] = true;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Baseline, testing::Values("lin", "x_view", "semantic_histogram"),
                         [](const auto& name) { return std::string(name.param); });

TEST(PlaceMatcherHook, HandsOnWhatWasFound) {
  const Objects global = Strewn(60, 60, 20, 5),
                local = SeenFrom(global, {1, Vec3(3, 4, 0)}, Vec2(30, 30), 20, 0.2);
  BaselineOptions options;
  const std::vector<std::pair<PlaceMatcher, LayoutMatcher>> cases{
      {LinMatcher(options.lin), Matcher("lin")},
      {XViewMatcher(options.x_view), Matcher("x_view")},
      {SemanticHistogramMatcher(options.semantic_histogram), Matcher("semantic_histogram")}};
  for (const auto& [hook, match] : cases) {
    const auto answer = hook({local, global, 100, 50});
    const auto expected = match(local, global);
    ASSERT_TRUE(answer && expected);
    EXPECT_EQ(answer->matches, expected->matches);
    EXPECT_EQ(answer->score, expected->score);
    EXPECT_TRUE(answer->accepted);
    EXPECT_EQ(answer->match_frame, -1);
    EXPECT_FALSE(hook({{}, global, 100, 50}));
  }
}

TEST(Lin, AcceptScoreDecidesWhatIsTaken) {
  const Objects global = Strewn(60, 60, 20, 5),
                local = SeenFrom(global, {1, Vec3(3, 4, 0)}, Vec2(30, 30), 20, 0.2);
  LinOptions options;
  const double score = MatchLin(local, global, options)->score;
  ASSERT_GT(score, options.accept_score);
  EXPECT_LE(score, 1);
  options.accept_score = 1.01 * score;
  EXPECT_FALSE(MatchLin(local, global, options)->accepted);
}

TEST(SemanticHistogram, ScoreIsTheNumberOfMatches) {
  const Objects global = Strewn(60, 60, 20, 5),
                local = SeenFrom(global, {1, Vec3(3, 4, 0)}, Vec2(30, 30), 20, 0.2);
  SemanticHistogramOptions options;
  const auto answer = MatchSemanticHistogram(local, global, options);
  EXPECT_EQ(answer->score, static_cast<double>(answer->matches.size()));
  options.consensus.least_inliers = static_cast<int>(answer->matches.size()) + 1;
  EXPECT_FALSE(MatchSemanticHistogram(local, global, options));
}

TEST(XView, MoreCandidatesMoreMatches) {
  const Objects global = Strewn(80, 80, 3, 5),
                local = SeenFrom(global, {1, Vec3(3, 4, 0)}, Vec2(40, 40), 25, 0.2);
  XViewOptions options;
  options.candidates = 1;
  const auto one = MatchXView(local, global, options);
  options.candidates = 20;
  const auto many = MatchXView(local, global, options);
  ASSERT_TRUE(many);
  EXPECT_GT(many->matches.size(), one ? one->matches.size() : 0);
  EXPECT_NEAR(many->pose.yaw, 1, 0.05);
}

}  // namespace
}  // namespace sslcd::baselines
