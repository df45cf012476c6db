// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/loop/layout_likelihood.h"

#include <gtest/gtest.h>

#include "layout_cases.h"

namespace sslcd {
namespace {

const YawShift kPose{2.5, {30, -20, 1.5}};

struct Case {
  std::vector<LayoutObject> map = Strewn(80, 80, 1),
                            local = SeenFrom(map, kPose, {0, 0}, 20, 0.2, 2);
  LayoutIndex index{map, 50, 2};
};

TEST(AlignPoints, FindsTheTurnAndTheShift) {
  const std::vector<Vec3> from = {{0, 0, 0}, {4, 1, 1}, {-2, 5, 0.5}};
  std::vector<Vec3> to;
  for (const Vec3& point : from) to.push_back(Apply(kPose, point));
  const YawShift pose = AlignPoints(from, to);
  EXPECT_NEAR(pose.yaw, kPose.yaw, 1e-12);
  EXPECT_LT((pose.t - kPose.t).norm(), 1e-12);
  EXPECT_EQ(AlignPoints({Vec3(1, 2, 3)}, {Vec3(2, 2, 2)}).t, Vec3(1, 0, -1));
}

TEST(LayoutLikelihood, PrefersTheTruth) {
  const Case c;
  const LayoutLikelihood likelihood(c.local, c.index, {});
  const LayoutFit truth = likelihood.Evaluate(kPose);
  EXPECT_EQ(truth.matches.size(), c.local.size());
  EXPECT_GT(truth.evidence, 5);
  EXPECT_LT(truth.evidence, truth.score) << "a pose that had to be searched is worth less";
  for (const YawShift& wrong : {YawShift{2.6, kPose.t}, YawShift{2.5, kPose.t + Vec3(1.5, 0, 0)},
                                YawShift{2.5, kPose.t + Vec3(0, 0, 1)}, YawShift{}})
    EXPECT_LT(likelihood.Evaluate(wrong).score, truth.score - 5);
}

TEST(LayoutLikelihood, MatchesAreOneToOne) {
  Case c;
  const std::size_t count = c.local.size();
  c.local.insert(c.local.end(), c.local.begin(), c.local.begin() + 5);
  const LayoutFit fit = LayoutLikelihood(c.local, c.index, {}).Evaluate(kPose);
  EXPECT_LE(fit.matches.size(), count + 1);
  for (std::size_t i = 0; i < fit.matches.size(); ++i)
    for (std::size_t j = i + 1; j < fit.matches.size(); ++j) {
      EXPECT_NE(fit.matches[i].first, fit.matches[j].first);
      EXPECT_NE(fit.matches[i].second, fit.matches[j].second);
    }
}

TEST(LayoutLikelihood, MissesOnBothSidesCost) {
  const Case c;
  const double score = LayoutLikelihood(c.local, c.index, {}).Evaluate(kPose).score;
  std::vector<LayoutObject> more = c.local;
  more.push_back(ObjectAt(c.local[0].position + Vec3(3, 3, 0)));
  EXPECT_LT(LayoutLikelihood(more, c.index, {}).Evaluate(kPose).score, score)
      << "the map lacks one";
  std::vector<LayoutObject> map = c.map;
  map.push_back(ObjectAt({0.5, 0.5, 0}));
  const LayoutIndex fuller(map, 50, 2);
  EXPECT_LT(LayoutLikelihood(c.local, fuller, {}).Evaluate(kPose).score, score)
      << "one of the map was not seen";
}

TEST(LayoutLikelihood, AWrongLabelCostsButDoesNotForbid) {
  Case c;
  const double score = LayoutLikelihood(c.local, c.index, {}).Evaluate(kPose).score;
  c.local[0].label = (c.local[0].label + 1) % 3;
  const LayoutFit fit = LayoutLikelihood(c.local, c.index, {}).Evaluate(kPose);
  EXPECT_EQ(fit.matches.size(), c.local.size());
  EXPECT_LT(fit.score, score - 1);
}

TEST(LayoutLikelihood, RefinesAPoseNearby) {
  const Case c;
  YawShift pose{2.55, kPose.t + Vec3(0.6, -0.5, 0.2)};
  LayoutLikelihood(c.local, c.index, {}).Refine(pose, 4);
  EXPECT_LT(ShiftBetween(pose, kPose, c.local[0].position), 0.3);
  EXPECT_NEAR(pose.yaw, kPose.yaw, 0.02);
}

}  // namespace
}  // namespace sslcd
