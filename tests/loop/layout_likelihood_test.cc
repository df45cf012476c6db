// SPDX-License-Identifier: BSD-3-Clause
#include "loop/layout_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "layout_cases.h"
#include "loop/heading_density.h"

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

double NormalDensity(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (std::sqrt(2 * M_PI) * sigma);
}

// Of `yes` among `all` outcomes in a given order, when their rate has a Beta prior.
double LogShare(double yes, double all, double prior_yes, double prior_no) {
  const auto log_beta = [](double a, double b) {
    return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b);
  };
  return log_beta(yes + prior_yes, all - yes + prior_no) - log_beta(prior_yes, prior_no);
}

// One match: where the two objects are apart, and what label and heading say.
struct Apart {
  double horizontal_m = 0, vertical_m = 0, semantic_gain = 0;
};

// The likelihood as its equation has it, over sets of objects instead of match by match: every
// match counts against the density of the map, then the share of local objects that the map has,
// and the share of the map's objects in sight that were seen. The scatter is unknown: the mean over
// four values.
struct Equation {
  std::vector<Apart> matches;
  double local = 0;           // objects on the map, matched or not
  double in_sight = 0;        // of the map, matched or not
  double spread_m2 = 0;       // squared distances of the matched ones from their centre
  LayoutLikelihoodOptions o;  // as the likelihood under test has them

  LayoutFit On(const LayoutIndex& index) const {
    const double searched =
        2 * M_PI * static_cast<double>(index.objects().size()) / index.density();
    const auto n = static_cast<double>(matches.size());
    double score = 0, evidence = 0;
    for (const double sigma : {0.15, 0.3, 0.5, 0.8}) {
      double log_ratio = LogShare(n, local, o.mapped_prior, o.unmapped_prior) +
                         LogShare(n, in_sight, o.seen_prior, o.unseen_prior);
      const double sigma_z = 0.06 + 0.4 * sigma, any_z = std::hypot(sigma_z, index.height_spread());
      for (const Apart& apart : matches) {
        const double horizontal =
            NormalDensity(apart.horizontal_m, sigma) * NormalDensity(0, sigma) / index.density();
        const double vertical =
            NormalDensity(apart.vertical_m, sigma_z) / NormalDensity(apart.vertical_m, any_z);
        log_ratio += std::log(horizontal) +
                     std::log(o.wrong_height + (1 - o.wrong_height) * vertical) +
                     apart.semantic_gain;
      }
      // of poses (x, y, yaw) that fit as well, out of all that could have been found
      const double volume =
          std::pow(2 * M_PI, 1.5) * std::pow(sigma, 3) / n / std::sqrt(spread_m2 + 1e-3);
      score += std::exp(log_ratio) / 4;
      evidence += std::exp(log_ratio) * volume / searched / 4;
    }
    LayoutFit fit;
    fit.score = std::log(score);
    fit.evidence = std::log(evidence);
    return fit;
  }
};

void ExpectEquation(const LayoutFit& fit, const Equation& equation, const LayoutIndex& index) {
  const LayoutFit expected = equation.On(index);
  EXPECT_EQ(fit.matches.size(), equation.matches.size());
  EXPECT_EQ(fit.should_see, equation.in_sight);
  EXPECT_NEAR(fit.score, expected.score, 1e-6);
  EXPECT_NEAR(fit.evidence, expected.evidence, 1e-6);
}

std::vector<LayoutObject> Square() {  // 50 m^2 off its centre each
  return {ObjectAt({0, 0, 0}), ObjectAt({10, 0, 0}), ObjectAt({10, 10, 0}), ObjectAt({0, 10, 0})};
}

TEST(LayoutLikelihoodEquation, DistanceDensityAndShares) {
  std::vector<LayoutObject> map = Square(), local = Square();
  map.push_back(ObjectAt({5, 8, 0}));    // in sight, not seen
  local.push_back(ObjectAt({5, 3, 0}));  // not mapped
  local[0].position.x() += 0.1;
  const LayoutIndex index(map, 50, 2);
  ExpectEquation(LayoutLikelihood(local, index, {}).Evaluate({}),
                 {{{0.1, 0, 0}, {}, {}, {}}, 5, 5, 200, {}}, index);
}

TEST(LayoutLikelihoodEquation, NothingUnmappedAndNothingUnseen) {
  const LayoutIndex index(Square(), 50, 2);
  const std::vector<LayoutObject> local = Square();
  LayoutLikelihoodOptions options;
  options.mapped_prior = 3;
  options.unmapped_prior = 4;
  options.seen_prior = 5;
  options.unseen_prior = 2;
  const Equation equation{{{}, {}, {}, {}}, 4, 4, 200, options};
  ExpectEquation(LayoutLikelihood(local, index, options).Evaluate({}), equation, index);
}

TEST(LayoutLikelihoodEquation, OneMatch) {
  const LayoutIndex index({ObjectAt({0, 0, 0}), ObjectAt({30, 0, 0})}, 50, 2);
  const std::vector<LayoutObject> local = Square();
  ExpectEquation(LayoutLikelihood(local, index, {}).Evaluate({}), {{{}}, 4, 1, 0, {}}, index);
}

TEST(LayoutLikelihoodEquation, Heights) {
  std::vector<LayoutObject> map = Square();
  for (std::size_t i = 0; i < 4; ++i) map[i].position.z() = i % 2 == 0 ? 0.4 : -0.4;
  std::vector<LayoutObject> local = map;
  local[1].position.z() += 0.3;
  const LayoutIndex index(map, 50, 2);
  EXPECT_GT(index.height_spread(), 0.3);
  ExpectEquation(LayoutLikelihood(local, index, {}).Evaluate({}),
                 {{{}, {0, 0.3, 0}, {}, {}}, 4, 4, 200, {}}, index);
}

TEST(LayoutLikelihoodEquation, RareLabelsTellMore) {
  std::vector<LayoutObject> map = Square();
  map[0].label = 7;
  std::vector<LayoutObject> local = map;
  local[3].label = 9;  // known of the local map alone
  const LayoutIndex index(map, 50, 2);
  // By the rule of succession over three labels: (times seen + 1) / (objects + labels).
  const double right = 1 - LayoutLikelihoodOptions().wrong_label;
  const double rare = std::log(right / (2 / 7.)), common = std::log(right / (4 / 7.)),
               wrong = std::log(1 - right);
  const Equation equation{
      {{0, 0, rare}, {0, 0, common}, {0, 0, common}, {0, 0, wrong}}, 4, 4, 200, {}};
  ExpectEquation(LayoutLikelihood(local, index, {}).Evaluate({}), equation, index);
}

TEST(LayoutLikelihoodEquation, HeadingsAgainstThoseOfOtherObjectsOfTheMap) {
  for (const Symmetry symmetry : {Symmetry::kNone, Symmetry::kPi}) {
    std::vector<LayoutObject> map = Square();
    for (std::size_t i = 0; i < 4; ++i) {
      map[i].symmetry = symmetry;
      map[i].yaw = i < 3 ? 0 : M_PI / 2;
    }
    std::vector<LayoutObject> local = map;
    local[0].yaw = 0.03;
    local[1].yaw = std::nan("");  // says nothing
    local[2].symmetry = Symmetry::kFull;
    const LayoutIndex index(map, 50, 2);
    // Other objects of this map face along x three times of four, anywhere once in five.
    const auto density = [&](double angle) { return HeadingDensity(angle, symmetry); };
    const double quarter = M_PI / 2, any = 1 / (2 * M_PI);
    const double along_x = (3 * density(0) + density(quarter) + any) / 5,
                 along_y = (3 * density(quarter) + density(0) + any) / 5;
    const Equation equation{
        {{0, 0, std::log(density(0.03) / along_x)}, {}, {}, {0, 0, std::log(density(0) / along_y)}},
        4,
        4,
        200,
        {}};
    EXPECT_LT(along_y, along_x);
    ExpectEquation(LayoutLikelihood(local, index, {}).Evaluate({}), equation, index);
  }
}

TEST(LayoutLikelihood, AllFacingTheWrongWayIsNoMatchOfHeadings) {
  std::vector<LayoutObject> map = Square();
  for (LayoutObject& object : map) object.yaw = 0.3;
  std::vector<LayoutObject> reversed = map;
  for (LayoutObject& object : reversed) object.yaw += M_PI;
  const LayoutIndex index(map, 50, 2);
  const double gained = LayoutLikelihood(map, index, {}).Evaluate({}).score -
                        LayoutLikelihood(reversed, index, {}).Evaluate({}).score;
  const double each =
      std::log(HeadingDensity(0, Symmetry::kNone) / HeadingDensity(M_PI, Symmetry::kNone));
  EXPECT_NEAR(gained, 4 * each, 0.1);
}

TEST(LayoutLikelihood, AMatchOutOfSightCountsAsOneMoreThatWasSeen) {
  std::vector<LayoutObject> map = Square();
  for (LayoutObject& object : map)  // beyond the margin of 1 m about the local objects
    object.position.x() += object.position.x() > 5 ? 1.05 : -1.05;
  const std::vector<LayoutObject> local = Square();
  const LayoutIndex index(map, 50, 2);
  const Apart apart{1.05, 0, 0};
  const Equation equation{{apart, apart, apart, apart}, 4, 4, 4 * (6.05 * 6.05 + 25), {}};
  const LayoutFit fit = LayoutLikelihood(local, index, {}).Evaluate({});
  EXPECT_EQ(fit.should_see, 4);
  // Where the scatter is small nothing matches; that adds little to the mean.
  EXPECT_NEAR(fit.score, equation.On(index).score, 0.01);
}

TEST(LayoutLikelihood, ShouldSeeWhatLiesWithinAMetreOfTheLocalObjects) {
  for (const auto& [x, count] :
       {std::pair<double, int>{5, 5}, {10.9, 5}, {11.1, 4}, {-0.9, 5}, {-1.1, 4}}) {
    std::vector<LayoutObject> map = Square();
    map.push_back(ObjectAt({x, 5, 0}));
    const LayoutIndex index(map, 50, 2);
    const std::vector<LayoutObject> local = Square();
    EXPECT_EQ(LayoutLikelihood(local, index, {}).Evaluate({}).should_see, count) << x;
  }
}

TEST(LayoutLikelihood, TurnsAndShiftsWithTheMap) {
  std::vector<LayoutObject> map = Strewn(40, 50, 3);
  for (std::size_t i = 0; i < map.size(); ++i) map[i].yaw = 0.7 * static_cast<double>(i);
  const std::vector<LayoutObject> local = SeenFrom(map, {}, {0, 0}, 18, 0.2, 2);
  std::vector<LayoutObject> moved = map;
  const YawShift pose{M_PI / 2, {7, -3, 2}};  // whole degrees: headings are kept in bins of one
  for (LayoutObject& object : moved) {
    object.position = Apply(pose, object.position);
    object.yaw = WrapAngle(object.yaw + pose.yaw);
  }
  const LayoutIndex index(map, 50, 2), moved_index(moved, 50, 2);
  const LayoutFit before = LayoutLikelihood(local, index, {}).Evaluate({}),
                  after = LayoutLikelihood(local, moved_index, {}).Evaluate(pose);
  EXPECT_EQ(before.matches, after.matches);
  EXPECT_NEAR(before.score, after.score, 1e-6);
  EXPECT_NEAR(before.evidence, after.evidence, 1e-6);
}

TEST(LayoutLikelihood, BeyondTheRimOfTheMapNothingIsUnmapped) {
  std::vector<LayoutObject> local = Square();
  const LayoutIndex index(Square(), 50, 2);
  LayoutLikelihoodOptions options, finished;
  options.leave_map = true;
  finished.leave_map = false;
  const double score = LayoutLikelihood(local, index, options).Evaluate({}).score;
  local.push_back(ObjectAt({200, 5, 0}));
  EXPECT_NEAR(LayoutLikelihood(local, index, options).Evaluate({}).score, score, 1e-9);
  EXPECT_LT(LayoutLikelihood(local, index, finished).Evaluate({}).score, score - 0.5)
      << "a map of all there is";
  local.back().position = {5, 4, 0};
  EXPECT_LT(LayoutLikelihood(local, index, options).Evaluate({}).score, score - 0.5)
      << "among mapped objects";
}

// Far beyond the rim on any side nothing is unmapped; right beside the mapped objects it is.
TEST(LayoutLikelihood, WhereTheMapEndsIsAskedUnderThePose) {
  const YawShift pose{0.7, {100, 40, 0}};
  const Vec3 corner(200, 300, 0);  // of the square in the local frame
  std::vector<LayoutObject> square = Square();
  for (LayoutObject& object : square) object.position += corner;
  std::vector<LayoutObject> map = square;
  for (LayoutObject& object : map) object.position = Apply(pose, object.position);
  const LayoutIndex index(map, 50, 2);
  LayoutLikelihoodOptions options;
  options.leave_map = true;
  const auto score_with = [&](const std::vector<Vec3>& more) {
    std::vector<LayoutObject> local = square;
    for (const Vec3& position : more) local.push_back(ObjectAt(corner + position));
    return LayoutLikelihood(local, index, options).Evaluate(pose).score;
  };
  for (const Vec3& away : {Vec3(60, 5, 0), Vec3(-50, 5, 0), Vec3(5, 60, 0), Vec3(5, -50, 0)})
    EXPECT_NEAR(score_with({away}), score_with({}), 1e-9) << away.transpose();
  for (const Vec3& beside : {Vec3(15, 5, 0), Vec3(-5, 5, 0), Vec3(5, 15, 0), Vec3(5, -5, 0)})
    EXPECT_LT(score_with({beside}), score_with({}) - 0.1) << beside.transpose();
}

TEST(LayoutLikelihood, RefiningAnExactLayoutEndsAtItsPose) {
  const std::vector<LayoutObject> map = Strewn(40, 50, 3),
                                  local = SeenFrom(map, kPose, {0, 0}, 18, 0, 2);
  const LayoutIndex index(map, 50, 2);
  const LayoutLikelihood likelihood(local, index, {});
  YawShift pose{2.53, kPose.t + Vec3(0.5, -0.3, 0.1)}, again = pose;
  const LayoutFit fit = likelihood.Refine(pose, 4);
  EXPECT_NEAR(pose.yaw, kPose.yaw, 1e-9);
  EXPECT_LT((pose.t - kPose.t).norm(), 1e-9);
  EXPECT_EQ(fit.matches.size(), local.size());
  EXPECT_EQ(likelihood.Refine(again, 4).score, fit.score) << "the way is remembered";
}

}  // namespace
}  // namespace sslcd
