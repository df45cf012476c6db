// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "leaves.h"
#include "sslcd/core/error.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

template <class Struct>
std::map<std::string, std::string> LeavesOf(Struct options) {
  std::map<std::string, std::string> values;
  for (const Leaf& leaf : FindLeaves([&](FieldVisitor& v) { DescribeFields(v, options); }))
    values[leaf.key] = leaf.value;
  return values;
}

// Every section of Options and the leaves of the struct that owns it, default-constructed. One
// preset: loop.odometry is LongPathOdometryNoise.
std::map<std::string, std::map<std::string, std::string>> Owners() {
  return {{"filter", LeavesOf(DetectionFilterOptions())},
          {"colour", LeavesOf(ColourOptions())},
          {"noise", LeavesOf(DetectionNoise())},
          {"association", LeavesOf(AssociationOptions())},
          {"map", LeavesOf(MapOptions())},
          {"map.motion", LeavesOf(MotionTestOptions())},
          {"level", LeavesOf(LevelOptions())},
          {"window", LeavesOf(WindowOptions())},
          {"ba", LeavesOf(BaOptions())},
          {"ba.odometry", LeavesOf(OdometryNoise())},
          {"loop", LeavesOf(LoopOptions())},
          {"loop.layout", LeavesOf(LoopLayoutOptions())},
          {"loop.match", LeavesOf(LayoutMatchOptions())},
          {"loop.match.search", LeavesOf(PoseSearchOptions())},
          {"loop.match.likelihood", LeavesOf(LayoutLikelihoodOptions())},
          {"loop.match.likelihood.appearance", LeavesOf(AppearanceOptions())},
          {"loop.tracks", LeavesOf(PoseTrackOptions())},
          {"loop.acceptance", LeavesOf(LoopAcceptanceOptions())},
          {"loop.views", LeavesOf(LoopViewOptions())},
          {"loop.drift", LeavesOf(DriftOptions())},
          {"loop.odometry", LeavesOf(LongPathOdometryNoise())},
          {"loop.graph", LeavesOf(RobustPoseGraphOptions())},
          {"loop.paper", LeavesOf(PaperMatchOptions())},
          {"refine", LeavesOf(RefineOptions())}};
}

TEST(Options, EveryDefaultIsThatOfTheStructThatOwnsIt) {
  const auto owners = Owners();
  for (const auto& [key, value] : LeavesOf(Options())) {
    const std::string section = key.substr(0, key.rfind('.'));
    ASSERT_EQ(owners.count(section), 1u) << section << " is not in this test's list";
    EXPECT_EQ(owners.at(section).at(key.substr(section.size() + 1)), value) << key;
  }
  EXPECT_EQ(LeavesOf(DefaultOptions(Mode::kRobust)), LeavesOf(Options()));
}

TEST(Options, DefaultsAndPresetsFitTogether) {
  EXPECT_THAT(ToString(Check(Options())), IsEmpty());
  EXPECT_THAT(ToString(Check(DefaultOptions(Mode::kPaper))), IsEmpty());
}

TEST(Options, EveryNumberOutOfItsRangeIsNamed) {
  int numbers = 0;
  Options defaults;
  for (const Leaf& leaf : FindLeaves([&](FieldVisitor& v) { DescribeFields(v, defaults); })) {
    if (!leaf.number) continue;
    ++numbers;
    for (const double wrong : {leaf.low - 1, leaf.high + 1, std::nan("")}) {
      if (leaf.integer && std::isnan(wrong)) continue;
      Options options;
      SetNumber(leaf.key, wrong, [&](FieldVisitor& v) { DescribeFields(v, options); });
      const std::vector<FieldProblem> problems = Check(options);
      ASSERT_FALSE(problems.empty()) << leaf.key << " " << wrong;
      EXPECT_EQ(problems[0].keys, std::vector<std::string>{leaf.key});
      EXPECT_THAT(problems[0].message, HasSubstr("must be in ["));
    }
  }
  EXPECT_GT(numbers, 50);
}

TEST(Options, AllThatDoesNotFitTogetherIsNamedAtOnce) {
  Options options;
  options.filter.min_size_m = options.filter.max_size_m + 1;
  options.association.gate_m = options.map.search_radius_m + 1;
  options.loop.lag_m = options.loop.layout.local_m + 1;
  CosineStatistics& looks = options.loop.match.likelihood.appearance.cosine[Cue::kEmbedding];
  looks.other_object = looks.opposite_side + 0.01;
  options.loop.acceptance.max_risk = 0.9 * options.loop.tracks.look_alike;
  const std::vector<FieldProblem> problems = Check(options);
  std::vector<std::string> keys;
  for (const FieldProblem& problem : problems) keys.push_back(problem.keys.at(0));
  EXPECT_THAT(
      keys, ElementsAre("filter.min_size_m", "association.gate_m", "loop.lag_m",
                        "loop.tracks.look_alike", "loop.match.likelihood.appearance.other_object"));
  looks.opposite_side = looks.same_side + 0.01;
  EXPECT_EQ(Check(options).size(), 5u);
  looks.other_object = looks.opposite_side;
  EXPECT_EQ(Check(options).size(), 5u) << "equal is not yet wrong";
  EXPECT_EQ(Check(options)[4].keys[0], "loop.match.likelihood.appearance.opposite_side");
}

TEST(Options, EqualBoundsFitTogether) {
  Options options;
  options.filter.min_size_m = options.filter.max_size_m;
  options.association.gate_m = options.map.search_radius_m;
  options.loop.lag_m = options.loop.layout.local_m;
  options.loop.acceptance.max_risk = options.loop.tracks.look_alike;
  EXPECT_THAT(Check(options), IsEmpty());
}

TEST(Options, TheMapperRefusesWhatDoesNotFitWithAllReasons) {
  Options options;
  options.loop.layout.every_m = std::numeric_limits<double>::quiet_NaN();
  options.window.keyframes = 0;
  options.loop.lag_m = 100;
  try {
    const Mapper mapper(options, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadConfig);
    EXPECT_THAT(error.what(), HasSubstr("window.keyframes: 'keyframes' is 0, must be in [2, 100]"));
    EXPECT_THAT(error.what(), HasSubstr("loop.layout.every_m: 'every_m' is nan"));
    EXPECT_THAT(error.what(), HasSubstr("loop.lag_m is 100, must be at most loop.layout.local_m"));
  }
}

}  // namespace
}  // namespace sslcd
