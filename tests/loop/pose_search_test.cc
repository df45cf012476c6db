// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "layout_cases.h"

namespace sslcd {
namespace {

const YawShift kPose{-1.2, {-300, 200, 3}};

std::vector<PoseHypothesis> Search(const std::vector<LayoutObject>& local,
                                   const std::vector<LayoutObject>& map,
                                   const PoseSearchOptions& options = {}) {
  return SearchPoses(LayoutLikelihood(local, LayoutIndex(map, 50, 2), {}), options);
}

TEST(SearchPoses, TheTruthComesFirst) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::vector<LayoutObject> map = Strewn(80, 80, seed);
    const std::vector<LayoutObject> local = SeenFrom(map, kPose, {10, 0}, 18, 0.2, seed);
    const std::vector<PoseHypothesis> found = Search(local, map);
    ASSERT_FALSE(found.empty());
    EXPECT_LT(ShiftBetween(found[0].pose, kPose, local[0].position), 1.) << "seed " << seed;
  }
}

TEST(SearchPoses, AStartWhoseMatchesSpeakAgainstItIsGivenUp) {
  const std::vector<LayoutObject> map = Strewn(80, 80, 1),
                                  local = SeenFrom(map, kPose, {0, 0}, 20, 0.2, 2);
  const LayoutIndex index(map, 50, 2);
  const LayoutLikelihood likelihood(local, index, {});
  YawShift right = kPose, wrong{1, kPose.t};
  EXPECT_GT(likelihood.Refine(right, kRefineRounds, 5).matches.size(), 10u);
  EXPECT_TRUE(likelihood.Refine(wrong, kRefineRounds, 5).matches.empty());
}

TEST(SearchPoses, HypothesesAreDistinctAndSorted) {
  std::vector<LayoutObject> grid;
  for (int i = 0; i < 48; ++i) grid.push_back(ObjectAt({2.5 * (i % 8), 6. * (i / 8), 0}));
  const std::vector<LayoutObject> local(grid.begin(), grid.begin() + 20);
  const PoseSearchOptions options;
  const std::vector<PoseHypothesis> found = Search(local, grid, options);
  ASSERT_GT(found.size(), 4u);
  Vec3 centre = Vec3::Zero();
  for (const LayoutObject& object : local) centre += object.position / 20.;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_GE(static_cast<int>(found[i].fit.matches.size()), options.min_matches);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(found[j].fit.evidence, found[i].fit.evidence);
      EXPECT_TRUE(ShiftBetween(found[i].pose, found[j].pose, centre) >= options.distinct_m ||
                  std::abs(WrapAngle(found[i].pose.yaw - found[j].pose.yaw)) >=
                      options.distinct_rad);
    }
  }
}

// Each shift along an even row is a pose.
TEST(SearchPoses, NoMorePosesThanAreRefined) {
  std::vector<LayoutObject> row;
  for (int i = 0; i < 12; ++i) row.push_back(ObjectAt({6. * i, 0, 0}));
  EXPECT_GT(Search(row, row).size(), 3u);
  PoseSearchOptions options;
  for (const int refine : {1, 3}) {
    options.refine = refine;
    const auto found = Search(row, row, options);
    EXPECT_FALSE(found.empty());
    EXPECT_LE(static_cast<int>(found.size()), refine);
  }
}

TEST(SearchPoses, AnEvenRowFitsBothWaysRound) {
  std::vector<LayoutObject> row;
  for (int i = 0; i < 12; ++i) row.push_back(ObjectAt({6. * i, 0, 0}));
  int ahead = 0, reversed = 0;
  for (const PoseHypothesis& one : Search(row, row)) {
    if ((Apply(one.pose, Vec3(33, 0, 0)) - Vec3(33, 0, 0)).norm() > 1) continue;
    (std::cos(one.pose.yaw) > 0 ? ahead : reversed) += 1;
  }
  EXPECT_EQ(ahead, 1);
  EXPECT_EQ(reversed, 1);
}

// 80 equal trees in a row: the local map of 12 of them fits at 69 places, both ways round.
struct EvenRow {
  static constexpr int kSeen = 12;
  std::vector<LayoutObject> row;

  EvenRow() {
    for (int i = 0; i < 80; ++i) row.push_back(ObjectAt({6. * i, 0, 0}));
  }
  // Whether the local map of the trees from `first` on is found where it is.
  bool FindsTruth(int first, const std::function<double(const YawShift&)>& prior) const {
    std::vector<LayoutObject> local(row.begin() + first, row.begin() + first + kSeen);
    PoseSearchOptions options;
    options.refine = 15;
    const LayoutIndex index(row, 50, 2);
    for (const PoseHypothesis& found :
         SearchPoses(LayoutLikelihood(local, index, {}), options, prior))
      if (ShiftBetween(found.pose, {}, local[0].position) < 1 &&
          std::abs(WrapAngle(found.pose.yaw)) < 0.1)
        return true;
    return false;
  }
};

TEST(SearchPoses, ThePriorSavesThePoseNextToItWhereTheMapRepeatsItself) {
  const EvenRow trees;
  const auto near_truth = [](const YawShift& pose) {
    return -pose.t.head<2>().norm() - std::abs(WrapAngle(pose.yaw));
  };
  int without = 0, with = 0;
  const std::vector<int> firsts{0, 9, 21, 34, 47, 55, 68};
  for (const int first : firsts) {
    without += trees.FindsTruth(first, {}) ? 1 : 0;
    with += trees.FindsTruth(first, near_truth) ? 1 : 0;
  }
  EXPECT_EQ(with, static_cast<int>(firsts.size()));
  EXPECT_LE(without, 3) << "15 of 138 equal poses";
}

TEST(SearchPoses, ThePriorCostsNoPoseThatFitsBest) {
  const std::vector<LayoutObject> map = Strewn(80, 80, 3);
  const std::vector<LayoutObject> local = SeenFrom(map, kPose, {10, 0}, 18, 0.2, 3);
  const auto far = [](const YawShift& pose) { return -(pose.t - Vec3(5000, 0, 0)).norm(); };
  const LayoutIndex index(map, 50, 2);
  const auto found = SearchPoses(LayoutLikelihood(local, index, {}), {}, far);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(ShiftBetween(found[0].pose, kPose, local[0].position), 1.);
  EXPECT_EQ(found[0].fit.evidence, Search(local, map)[0].fit.evidence);
}

TEST(SearchPoses, TheOrderOfTheObjectsDoesNotMatter) {
  const std::vector<LayoutObject> map = Strewn(60, 70, 4);
  std::vector<LayoutObject> local = SeenFrom(map, kPose, {0, 0}, 18, 0.2, 5);
  const auto a = Search(local, map);
  std::reverse(local.begin(), local.end());
  const auto b = Search(local, map);
  ASSERT_FALSE(a.empty());
  ASSERT_FALSE(b.empty());
  EXPECT_LT(ShiftBetween(a[0].pose, b[0].pose, local[0].position), 0.05);
  EXPECT_NEAR(a[0].fit.evidence, b[0].fit.evidence, 0.05);
}

TEST(SearchPoses, NothingIsFoundInNothing) {
  const std::vector<LayoutObject> map = Strewn(30, 60, 1);
  EXPECT_TRUE(Search({}, map).empty());
  EXPECT_TRUE(Search(map, {}).empty());
  EXPECT_TRUE(Search({map[0]}, {map[0]}).empty());
}

}  // namespace
}  // namespace sslcd
