// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/layout_match.h"

#include <gmock/gmock.h>

#include <cmath>

#include "layout_cases.h"

namespace sslcd {
namespace {

const YawShift kPose{2.5, {30, -20, 1.5}};

TEST(MatchLayouts, FindsItsPlaceInAStrewnMap) {
  const std::vector<LayoutObject> map = Strewn(60, 80, 1);
  const std::vector<LayoutObject> local = SeenFrom(map, kPose, {10, 5}, 18, 0.2, 2);
  ASSERT_GE(local.size(), 6u);
  const LayoutAnswer answer = MatchLayouts(local, map);
  EXPECT_EQ(answer.decision, LoopDecision::kAccepted) << answer.reason;
  ASSERT_FALSE(answer.hypotheses.empty());
  EXPECT_LT(ShiftBetween(answer.hypotheses[0].pose, kPose, local[0].position), 0.5);
  EXPECT_NEAR(WrapAngle(answer.hypotheses[0].pose.yaw - kPose.yaw), 0, 0.03);
  EXPECT_EQ(answer.hypotheses[0].fit.matches.size(), local.size());
  EXPECT_GT(answer.score, answer.second_score);
}

TEST(MatchLayouts, HoldsFromAnyDirection) {
  const std::vector<LayoutObject> map = Strewn(60, 80, 3);
  for (double yaw = -3; yaw <= 3; yaw += 0.5) {
    const YawShift pose{yaw, {5, 300, 0}};
    const LayoutAnswer answer = MatchLayouts(SeenFrom(map, pose, {-5, 0}, 18, 0.1, 4), map);
    ASSERT_EQ(answer.decision, LoopDecision::kAccepted) << "yaw " << yaw << ": " << answer.reason;
    EXPECT_NEAR(WrapAngle(answer.hypotheses[0].pose.yaw - yaw), 0, 0.03);
  }
}

TEST(MatchLayouts, RefusesWhatIsTooLittle) {
  const std::vector<LayoutObject> map = Strewn(60, 80, 1);
  for (std::size_t count = 0; count < 4; ++count) {
    const std::vector<LayoutObject> few(map.begin(),
                                        map.begin() + static_cast<std::ptrdiff_t>(count));
    for (const LayoutAnswer& answer :
         {MatchLayouts(few, map), MatchLayouts(map, few), MatchLayouts(few, few)}) {
      EXPECT_EQ(answer.decision, LoopDecision::kNone) << count << " objects";
      EXPECT_THAT(answer.reason, testing::Not(testing::IsEmpty()));
    }
  }
}

TEST(MatchLayouts, DoesNotMatchTheMirrorImage) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const std::vector<LayoutObject> map = Strewn(100, 60, seed);
    std::vector<LayoutObject> mirrored = SeenFrom(map, kPose, {0, 0}, 20, 0.1, seed);
    ASSERT_EQ(MatchLayouts(mirrored, map).decision, LoopDecision::kAccepted);
    for (LayoutObject& object : mirrored) object.position.y() *= -1;
    EXPECT_NE(MatchLayouts(mirrored, map).decision, LoopDecision::kAccepted) << "seed " << seed;
  }
}

TEST(MatchLayouts, DoesNotMatchTheMirrorImageOfAFewObjects) {
  int cases = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const std::vector<LayoutObject> map = Strewn(80, 90, seed);
    std::vector<LayoutObject> mirrored = SeenFrom(map, kPose, {0, 0}, 16, 0.3, seed);
    if (mirrored.size() < 6 || mirrored.size() > 12 ||
        MatchLayouts(mirrored, map).decision != LoopDecision::kAccepted)
      continue;
    ++cases;
    for (LayoutObject& object : mirrored) object.position.y() *= -1;
    EXPECT_NE(MatchLayouts(mirrored, map).decision, LoopDecision::kAccepted) << "seed " << seed;
  }
  EXPECT_GT(cases, 30);
}

TEST(MatchLayouts,
     AnswersAreProperTurns) {  // even the best pose of a mirror image keeps left on the left
  const std::vector<LayoutObject> map = Strewn(40, 60, 5);
  std::vector<LayoutObject> mirrored = map;
  for (LayoutObject& object : mirrored) object.position.y() *= -1;
  for (const PoseHypothesis& hypothesis : MatchLayouts(mirrored, map).hypotheses)
    EXPECT_LT(hypothesis.fit.matches.size(), mirrored.size() / 2);
}

TEST(MatchLayouts, IsLostInAPerfectGrid) {
  std::vector<LayoutObject> grid;
  for (int i = 0; i < 30; ++i) grid.push_back(ObjectAt({2.5 * (i % 6), 6. * (i / 6), 0}));
  const std::vector<LayoutObject> part = SeenFrom(grid, kPose, {5, 12}, 7.5, 0., 1);
  ASSERT_GE(part.size(), 8u);
  EXPECT_EQ(MatchLayouts(part, grid).decision, LoopDecision::kAmbiguous) << "many shifts fit";
  EXPECT_EQ(MatchLayouts(grid, grid).decision, LoopDecision::kAmbiguous)
      << "the half-turn fits as well";
}

TEST(MatchLayouts, IsLostOnAnEvenLine) {
  std::vector<LayoutObject> even;
  for (int i = 0; i < 8; ++i) even.push_back(ObjectAt({6. * i, 0.1 * i, 0}));
  EXPECT_EQ(MatchLayouts(even, even).decision, LoopDecision::kAmbiguous)
      << "the half-turn fits as well";
}

TEST(MatchLayouts, UnevenSpacingsTellTheEndsOfALineApart) {
  std::vector<LayoutObject> line;
  for (const double x : {0., 7., 12., 21., 35., 41., 60.})
    line.push_back(ObjectAt({x, 0.2 * x, 0}));
  const LayoutAnswer answer = MatchLayouts(line, line);
  ASSERT_EQ(answer.decision, LoopDecision::kAccepted) << answer.reason;
  EXPECT_LT(ShiftBetween(answer.hypotheses[0].pose, {}, Vec3(60, 12, 0)), 0.01);
}

TEST(MatchLayouts, ObjectsOnOneSpotAreNoLayout) {
  const std::vector<LayoutObject> heap(12, ObjectAt({3, 4, 0}));
  EXPECT_EQ(MatchLayouts(heap, heap).decision, LoopDecision::kNone);
  EXPECT_EQ(MatchLayouts(heap, Strewn(60, 80, 1)).decision, LoopDecision::kNone);
}

TEST(MatchLayouts, DuplicateLandmarksDoNotCountTwice) {
  const std::vector<LayoutObject> map = Strewn(60, 80, 1);
  std::vector<LayoutObject> three = SeenFrom(map, kPose, {10, 5}, 18, 0., 2);
  three.resize(3);
  std::vector<LayoutObject> doubled = three;
  for (int copy = 0; copy < 4; ++copy) doubled.insert(doubled.end(), three.begin(), three.end());
  EXPECT_NE(MatchLayouts(doubled, map).decision, LoopDecision::kAccepted)
      << "three places, seen five times each";

  std::vector<LayoutObject> local = SeenFrom(map, kPose, {10, 5}, 18, 0.2, 2), global = map;
  local.push_back(local[0]);
  global.push_back(global[0]);
  const LayoutAnswer answer = MatchLayouts(local, global);
  EXPECT_EQ(answer.decision, LoopDecision::kAccepted) << answer.reason;
  EXPECT_LT(ShiftBetween(answer.hypotheses[0].pose, kPose, local[0].position), 0.5);
}

TEST(MatchLayouts, LeavesOutWhatIsNotFinite) {
  const std::vector<LayoutObject> map = Strewn(60, 80, 1);
  std::vector<LayoutObject> local = SeenFrom(map, kPose, {10, 5}, 18, 0.2, 2), dirty = map;
  const LayoutAnswer clean = MatchLayouts(local, map);
  dirty.push_back(ObjectAt({std::nan(""), 0, 0}));
  local.push_back(ObjectAt({0, INFINITY, 0}));
  const LayoutAnswer answer = MatchLayouts(local, dirty);
  EXPECT_EQ(answer.decision, clean.decision);
  EXPECT_EQ(answer.score, clean.score);
  const std::vector<LayoutObject> nothing(9, ObjectAt({std::nan(""), std::nan(""), 0}));
  EXPECT_EQ(MatchLayouts(nothing, map).decision, LoopDecision::kNone);
  EXPECT_EQ(MatchLayouts(local, nothing).decision, LoopDecision::kNone);
}

TEST(MatchLayouts, MatchesNameTheObjectsOfTheCaller) {
  const std::vector<LayoutObject> map = Strewn(60, 80, 1);
  std::vector<LayoutObject> local = SeenFrom(map, kPose, {10, 5}, 18, 0.1, 2), dirty = map;
  local.insert(local.begin(), ObjectAt({std::nan(""), 0, 0}));
  dirty.insert(dirty.begin() + 20, 3, ObjectAt({0, std::nan(""), 0}));
  const LayoutAnswer answer = MatchLayouts(local, map);
  ASSERT_EQ(answer.decision, LoopDecision::kAccepted);
  for (const auto& [i, j] : answer.hypotheses[0].fit.matches)
    EXPECT_LT((Apply(kPose, local[i].position) - map[j].position).norm(), 1.);
}

TEST(MatchLayouts, AnyLabelNumberIsFine) {
  std::vector<LayoutObject> map = Strewn(60, 80, 1);
  for (LayoutObject& object : map) object.label = object.label * 1000000000 - 1;
  const LayoutAnswer answer = MatchLayouts(SeenFrom(map, kPose, {10, 5}, 18, 0.2, 2), map);
  EXPECT_EQ(answer.decision, LoopDecision::kAccepted) << answer.reason;
}

// Poles along a line at uneven distances: only one shift and no turn fits.
std::vector<LayoutObject> UnevenLine() {
  std::vector<LayoutObject> line;
  for (const double x : {0., 7., 12., 21., 35., 41., 60.}) line.push_back(ObjectAt({x, 0, 0}));
  return line;
}

TEST(MatchLayouts, WithoutARivalTheMarginIsThatOverChance) {
  LayoutMatchOptions options;
  options.search.distinct_m = 1e6;  // all poses count as one
  options.search.distinct_rad = 4;
  for (const double chance : {-10., 3.}) {
    SingleLookOptions decision;
    decision.min_evidence = chance;
    const LayoutAnswer answer = MatchLayouts(UnevenLine(), UnevenLine(), options, decision);
    ASSERT_EQ(answer.hypotheses.size(), 1u);
    const double evidence = answer.hypotheses[0].fit.evidence;
    EXPECT_NEAR(answer.score, evidence - chance, 1e-9);
    EXPECT_NEAR(answer.second_score, chance - evidence, 1e-9);
  }
}

// A place, and copies of it 100 m apart, each less exact than the one before.
std::vector<LayoutObject> WithCopies(const std::vector<LayoutObject>& place, int copies) {
  std::vector<LayoutObject> map = place;
  for (int copy = 1; copy <= copies; ++copy) {
    for (std::size_t i = 0; i < place.size(); ++i) {
      map.push_back(place[i]);
      const double off = 0.15 * copy * (i % 2 == 0 ? 1 : -1);
      map.back().position += Vec3(100. * copy + off, off, 0);
    }
  }
  return map;
}

TEST(MatchLayouts, TheMarginIsTheLogOddsAgainstAllRivalsTogether) {
  const std::vector<LayoutObject> place = Strewn(10, 30, 4);
  for (const int copies : {1, 3}) {
    for (const double chance : {-10., 15., -2000.}) {
      SingleLookOptions decision;
      decision.min_evidence = chance;
      const LayoutAnswer answer = MatchLayouts(place, WithCopies(place, copies), {}, decision);
      ASSERT_EQ(static_cast<int>(answer.hypotheses.size()), copies + 1);
      const auto evidence = [&](std::size_t i) { return answer.hypotheses[i].fit.evidence; };
      const auto log_odds = [&](std::size_t of) {
        double rivals = std::exp(chance);
        for (std::size_t i = 0; i < answer.hypotheses.size(); ++i)
          if (i != of) rivals += std::exp(evidence(i));
        return evidence(of) - std::log(rivals);
      };
      EXPECT_GT(evidence(0), evidence(1) + 0.1);
      EXPECT_NEAR(answer.score, log_odds(0), 1e-6);
      EXPECT_NEAR(answer.second_score, log_odds(1), 1e-6);
    }
  }
}

TEST(MatchLayouts, TheSmallerOfBothMapsSaysWhetherThereIsEnough) {
  const std::vector<LayoutObject> map = Strewn(60, 80, 1), three(map.begin(), map.begin() + 3);
  for (const LayoutAnswer& answer : {MatchLayouts(three, map), MatchLayouts(map, three)})
    EXPECT_THAT(answer.reason, testing::StartsWith("3 objects are too few"));
}

TEST(MatchLayouts, AsManyObjectsAsHaveToAgreeAreEnough) {
  LayoutMatchOptions options;
  options.search.min_matches = 7;
  EXPECT_EQ(MatchLayouts(UnevenLine(), UnevenLine(), options).decision, LoopDecision::kAccepted);
  options.search.min_matches = 8;
  const LayoutAnswer answer = MatchLayouts(UnevenLine(), UnevenLine(), options);
  EXPECT_EQ(answer.decision, LoopDecision::kNone);
  EXPECT_THAT(answer.reason, testing::StartsWith("7 objects are too few"));
}

// A line lies on its own mirror image, so only the headings tell which of the two was seen.
TEST(MatchLayouts, TheMirrorImageTurnsHeadingsToo) {
  std::vector<LayoutObject> map = UnevenLine();
  for (std::size_t i = 0; i < map.size(); ++i)
    map[i].yaw = 0.6 + 0.3 * static_cast<double>(i % 4);  // to the left of the line, all of them
  std::vector<LayoutObject> mirrored = map;
  for (LayoutObject& object : mirrored) object.yaw *= -1;
  SingleLookOptions options;
  options.min_evidence = -1000;  // nothing but the mirror image refuses
  options.min_margin = -1000;
  EXPECT_EQ(MatchLayouts(map, map, {}, options).decision, LoopDecision::kAccepted);
  LayoutAnswer answer = MatchLayouts(mirrored, map, {}, options);
  EXPECT_EQ(answer.decision, LoopDecision::kNone);
  EXPECT_THAT(answer.reason, testing::HasSubstr("mirror"));
  // The mirror image of the mirror image is the map itself.
  const double gain =
      MatchLayouts(map, map).hypotheses[0].fit.evidence - answer.hypotheses[0].fit.evidence;
  ASSERT_GT(gain, 1);
  for (const double slack : {-0.1, 0.1}) {
    options.mirror_gain = gain + slack;
    answer = MatchLayouts(mirrored, map, {}, options);
    EXPECT_EQ(answer.decision == LoopDecision::kAccepted, slack > 0) << answer.reason;
  }
}

// The local map is the mirror image of a place, so its own mirror image is that place.
TEST(MatchLayouts, TheMirrorImageTurnsPositionsToo) {
  const std::vector<LayoutObject> map = Strewn(12, 40, 6);
  std::vector<LayoutObject> mirrored = map;
  for (LayoutObject& object : mirrored) object.position.y() *= -1;
  SingleLookOptions options;
  options.min_evidence = -1000;  // nothing but the mirror image refuses
  options.min_margin = -1000;
  const LayoutAnswer answer = MatchLayouts(mirrored, map, {}, options);
  ASSERT_FALSE(answer.hypotheses.empty());
  EXPECT_EQ(answer.decision, LoopDecision::kNone);
  EXPECT_THAT(answer.reason, testing::HasSubstr("mirror"));
}

TEST(MatchLayouts, AMirrorImageThatFitsNowhereSpeaksForThePose) {
  const std::vector<LayoutObject> map = Strewn(12, 40, 6);
  LayoutMatchOptions options;
  options.search.min_matches = 12;
  const LayoutAnswer answer = MatchLayouts(map, map, options);
  EXPECT_EQ(answer.decision, LoopDecision::kAccepted) << answer.reason;
}

}  // namespace
}  // namespace sslcd
