// SPDX-License-Identifier: BSD-3-Clause
#include "loop/drift_problem.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd::drift {
namespace {

constexpr double kMaxYawSigma = 0.5;
const GravityFrame kUpright = GravityFrame::FromUp(Vec3::UnitZ());

DriftPair Pair(const Vec3& local, const Vec3& global, double yaw_local, double yaw_global,
               Symmetry symmetry = Symmetry::kNone) {
  DriftPair pair;
  pair.T_world_local = Pose(Rotation::RotZ(yaw_local), local);
  pair.T_world_global = Pose(Rotation::RotZ(yaw_global), global);
  pair.symmetry = symmetry;
  return pair;
}

// Two objects on the x axis, `apart_m` between them, that have not moved but for their headings.
Problem Two(double apart_m, double turned_rad, Symmetry symmetry) {
  const Vec3 arm(apart_m / 2, 0, 0);
  return MakeProblem(
      {Pair(arm, arm, 0, turned_rad, symmetry), Pair(-arm, -arm, 0, turned_rad, symmetry)},
      kUpright, 0);
}

double YawOf(const Start& start) { return start.state.R.Log().z(); }

// Two poles at distance d, each off by sigma across: their direction is off by sigma sqrt(2) / d.
TEST(FindStart, PositionsFixTheYawFromTheirSigmaOn) {
  const double limit = DriftPair().sigma_horizontal_m * std::sqrt(2.) / kMaxYawSigma;
  std::string reason;
  const auto wide = FindStart(Two(1.02 * limit, 0, Symmetry::kFull), kMaxYawSigma, reason);
  ASSERT_TRUE(wide) << reason;
  EXPECT_TRUE(wide->by_positions);
  EXPECT_FALSE(FindStart(Two(0.98 * limit, 0, Symmetry::kFull), kMaxYawSigma, reason));
  EXPECT_NE(reason.find("nothing fixes the yaw"), std::string::npos) << reason;
  const auto narrow = FindStart(Two(0.98 * limit, 0.3, Symmetry::kNone), kMaxYawSigma, reason);
  ASSERT_TRUE(narrow) << "the headings do";
  EXPECT_FALSE(narrow->by_positions);
  EXPECT_NEAR(YawOf(*narrow), 0.3, 1e-9);
}

// Three in a row, whose positions say 0 and whose headings say 0.3 rad. Either yaw costs what the
// others are off, in sigmas squared: 0.3 times the arm for the outer two, or 0.3 itself for all.
TEST(FindStart, TakesTheYawThatCostsLess) {
  const DriftPair pair;
  const double even_arm = std::sqrt(1.5) * pair.sigma_horizontal_m / pair.sigma_yaw_rad;
  for (const double share : {0.9, 1.1}) {
    std::vector<DriftPair> pairs;
    for (const double side : {-1., 0., 1.}) {
      const Vec3 at(side * share * even_arm, 0, 0);
      pairs.push_back(Pair(at, at, 0, 0.3));
    }
    std::string reason;
    const auto start = FindStart(MakeProblem(pairs, kUpright, 0), kMaxYawSigma, reason);
    ASSERT_TRUE(start) << reason;
    EXPECT_NEAR(YawOf(*start), share < 1 ? 0.3 : 0, 1e-9);
  }
}

TEST(FindStart, AFewWrongPairsDoNotMoveTheShift) {
  std::vector<DriftPair> pairs;
  for (const double x : {0., 10., 20., 30., 40.})
    pairs.push_back(Pair({x, 0, 0}, {x + 1, 2, 3}, 0, 0));
  pairs[1].T_world_global.translation() += Vec3(0, 50, 0);
  std::string reason;
  const Problem problem = MakeProblem(pairs, kUpright, 2);
  const auto start = FindStart(problem, kMaxYawSigma, reason);
  ASSERT_TRUE(start) << reason;
  EXPECT_NEAR(YawOf(*start), 0, 1e-9);
  EXPECT_LT((start->state.t - problem.centre - Vec3(1, 2, 3)).norm(), 1e-9);
}

// Cars on one spot: four headings say 0, one 5 sigmas and one 20. By squares the middle one is
// best, by a loss that lets go of it what most say.
TEST(FindStart, WithALossTheMostHeadingsWin) {
  const double sigma = DriftPair().sigma_yaw_rad;
  std::vector<DriftPair> pairs;
  for (const double turned : {0., 0., 0., 0., 5., 20.})
    pairs.push_back(Pair({1, 2, 0}, {1, 2, 0}, 0, turned * sigma));
  for (const double loss_scale : {0., 0.5, 2., 1000.}) {
    std::string reason;
    const auto start = FindStart(MakeProblem(pairs, kUpright, loss_scale), kMaxYawSigma, reason);
    ASSERT_TRUE(start) << reason;
    const bool squares = loss_scale == 0 || loss_scale == 1000;
    EXPECT_NEAR(YawOf(*start), squares ? 5 * sigma : 0, 1e-9) << loss_scale;
  }
}

TEST(FindStart, ThePositionsSayTheYawWhereverTheMapsAre) {
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(300, -200, 5)}) {
    std::vector<DriftPair> pairs;
    for (const Vec3& p : {Vec3(5, 1, 0), Vec3(-3, 8, 1), Vec3(2, -6, 0)}) {
      pairs.push_back(Pair(p, Rotation::RotZ(0.7) * p + shift, 0, 0, Symmetry::kFull));
      pairs.back().sigma_horizontal_m = 0.1 * static_cast<double>(pairs.size());
    }
    std::string reason;
    const auto start = FindStart(MakeProblem(pairs, kUpright, 0), kMaxYawSigma, reason);
    ASSERT_TRUE(start) << reason;
    EXPECT_NEAR(YawOf(*start), 0.7, 1e-9);
  }
}

TEST(FindStart, FrontAndBackAlikeLeaveTwoYawsOnOneSpot) {
  const DriftPair box = Pair({1, 2, 0}, {1, 2, 0}, 0.1, 0.4, Symmetry::kPi);
  std::string reason;
  EXPECT_FALSE(FindStart(MakeProblem({box}, kUpright, 2), kMaxYawSigma, reason));
  EXPECT_NE(reason.find("half a turn"), std::string::npos) << reason;
  const DriftPair car = Pair({1, 2, 0}, {1, 2, 0}, 0.1, 0.4 + M_PI);
  const auto start = FindStart(MakeProblem({box, car}, kUpright, 2), kMaxYawSigma, reason);
  ASSERT_TRUE(start) << "one that has a front decides";
  EXPECT_NEAR(WrapAngle(YawOf(*start) - 0.3 - M_PI), 0, 1e-9);
}

TEST(DriftProblem, AnySigmaAboveZeroWillDo) {
  DriftPair pair = Pair({0, 0, 0}, {0, 0, 0}, 0, 0);
  for (const double sigma : {1e-3, 0.5, 5.}) {
    pair.sigma_horizontal_m = pair.sigma_vertical_m = pair.sigma_yaw_rad = sigma;
    EXPECT_EQ(Check({pair}), "");
  }
}

TEST(DriftProblem, AnUnknownHeadingIsNone) {
  LayoutObject pole, car;
  pole.yaw = std::nan("");
  car.yaw = 0.3;
  for (const DriftPair& pair : {MakeDriftPair(pole, car), MakeDriftPair(car, pole)})
    EXPECT_FALSE(MakeProblem({pair}, kUpright, 0).matches[0].has_yaw());
  EXPECT_TRUE(MakeProblem({MakeDriftPair(car, car)}, kUpright, 0).matches[0].has_yaw());
  EXPECT_EQ(MakeDriftPair(pole, car).T_world_local.so3().Log().norm(), 0);
}

TEST(DriftProblem, TheCentreIsWeightedByInformation) {
  DriftPair sure = Pair({0, 0, 0}, {0, 0, 0}, 0, 0), vague = Pair({10, 0, 0}, {10, 0, 0}, 0, 0);
  sure.sigma_horizontal_m = 0.1;
  vague.sigma_horizontal_m = 0.2;
  EXPECT_NEAR(MakeProblem({sure, vague}, kUpright, 2).centre.x(), 10. * 1 / (1 + 4), 1e-9);
}

TEST(DriftProblem, ErrorsAreThoseOfTheLocalObjectAsTheGlobalOneSeesIt) {
  const Problem problem = MakeProblem({Pair({5, 0, 0}, {3, 4, 1}, 0.2, M_PI / 2)}, kUpright, 2);
  const Match& match = problem.matches[0];
  const State moved{Rotation::RotZ(0.5), problem.centre + Vec3(0, 1, 0)};
  // It faces along y: what is ahead of it in the world's y is its x, to its left the world's -x.
  EXPECT_LT((PositionError(match, problem, moved) - Vec3(1 - 4, -(5 - 3), -1)).norm(), 1e-9);
  EXPECT_NEAR(YawError(match, moved), 0.2 + 0.5 - M_PI / 2, 1e-9);
  EXPECT_LT((Heading(match, moved) - Vec3(std::cos(0.7), std::sin(0.7), 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace sslcd::drift
