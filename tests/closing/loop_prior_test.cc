// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_prior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "two_passes.h"

namespace sslcd {
namespace {

constexpr double kFreedom = 8;

// The second pass of a grove against the first one. Both coordinates agree: no drift.
struct Prior {
  TwoPasses world;
  PassLayouts::Mark mark;
  LayoutIndex index{PassLayouts(world.passes, world.state).ChangesBefore(100, 2, mark).objects, 50,
                    2};
  PassLayout local = PassLayouts(world.passes, world.state).Recent(world.end_m() - 60, 2);
  int here = world.state.frames.AtPath(world.end_m() - 30);
  LayoutFit fit = Matches();
  std::optional<TrajectoryUncertainty> uncertainty;

  Prior() { CloseLoops({}); }

  // All trees: of the second pass, of the first.
  LayoutFit Matches() const {
    LayoutFit matches;
    for (std::size_t i = 0; i < local.objects.size(); ++i)
      for (std::size_t j = 0; j < index.objects().size(); ++j)
        if ((local.objects[i].position - index.objects()[j].position).norm() < 0.1)
          matches.matches.emplace_back(i, j);
    return matches;
  }
  void CloseLoops(const std::vector<LoopEdge>& loops, const OdometryModel& model = {}) {
    uncertainty.emplace(world.state, loops, model);
  }

  OdometryPrior Odometry() const {
    return {world.state, world.passes, local, index, *uncertainty, here};
  }
  // Midway between the camera and the mean of the objects.
  Vec3 Centre() const {
    const GravityFrame& gravity = world.state.gravity();
    Vec3 sum = gravity.Basis().transpose() * world.state.frames[here].T_world_cam.translation();
    for (const auto& [i, j] : fit.matches)
      sum += local.objects[i].position / static_cast<double>(fit.matches.size());
    return 0.5 * sum;
  }
  // A turn about Centre(), and a shift.
  YawShift Moved(double turn_rad, const Vec3& shift) const {
    YawShift pose{turn_rad, Vec3::Zero()};
    pose.t = Centre() + shift - Apply(pose, Centre());
    return pose;
  }
  PosePrior Of(double turn_rad, const Vec3& shift) const {
    return Odometry().Of(Moved(turn_rad, shift), fit);
  }
  double Level(double turn_rad, const Vec3& shift) const { return Of(turn_rad, shift).level; }
  // All matched objects seem to have risen.
  double Height(double rise_m) {
    const PassLayout before = local;
    for (LayoutObject& object : local.objects) object.altitude -= rise_m;
    const double height = Of(0, Vec3::Zero()).height;
    local = before;
    return height;
  }
};

TEST(OdometryPrior, FallsWithEveryMetreAndEveryTurn) {
  const Prior prior;
  ASSERT_GE(prior.fit.matches.size(), 15u);
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-0.6, 0.8, 0)}) {
    double before = prior.Level(0, Vec3::Zero());
    for (const double metres : {1., 5., 20., 80., 1000.}) {
      const double now = prior.Level(0, metres * way);
      EXPECT_LT(now, before - 0.1) << metres;
      before = now;
    }
  }
  for (const double sign : {-1., 1.}) {
    double before = prior.Level(0, Vec3::Zero());
    for (const double rad : {0.1, 0.5, 1., 3.}) {
      const double now = prior.Level(sign * rad, Vec3::Zero());
      EXPECT_LT(now, before - 0.1) << rad;
      before = now;
    }
  }
  EXPECT_NEAR(prior.Level(2 * M_PI, Vec3::Zero()), prior.Level(0, Vec3::Zero()), 1e-9);
  EXPECT_NEAR(prior.Level(0, Vec3(0, 0, 30)), prior.Level(0, Vec3::Zero()), 1e-9)
      << "layouts have heights of their own";
}

TEST(OdometryPrior, ATurnAboutTheCentreShiftsNothing) {
  const Prior prior;
  for (const double turn_rad : {-0.02, 0.02})
    for (const Vec3& way : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
      EXPECT_LT(prior.Level(turn_rad, 10 * way), prior.Level(turn_rad, Vec3::Zero()) - 1)
          << turn_rad << ", " << way.transpose();
}

// Next to the centre the log density falls by (nu + 3) / (2 nu) times the squared Mahalanobis
// distance, far from it by (nu + 3) / 2 times its logarithm.
TEST(OdometryPrior, IsAStudentTAndHasHeavierTailsThanAGaussian) {
  const Prior prior;
  const double here = prior.Level(0, Vec3::Zero());
  constexpr double kNear = 1e-3;
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    const double distance2_per_m2 =
        (here - prior.Level(0, kNear * way)) / (kNear * kNear) * 2 * kFreedom / (kFreedom + 3);
    for (const double sigmas : {1., 5., 20.}) {
      const double metres = sigmas / std::sqrt(distance2_per_m2);
      const double loss = here - prior.Level(0, metres * way);
      EXPECT_NEAR(loss, 0.5 * (kFreedom + 3) * std::log1p(sigmas * sigmas / kFreedom), 1e-2 * loss);
      EXPECT_LT(loss, 0.5 * (1 + 3 / kFreedom) * sigmas * sigmas) << "a Gaussian as narrow";
    }
  }
}

TEST(OdometryPrior, GrowsWithTheSearchedMap) {
  Prior prior;
  const double before = prior.Level(0, Vec3::Zero()), volume = prior.index.pose_volume();
  std::vector<LayoutObject> more = prior.index.objects();
  for (std::size_t i = 0, count = more.size(); i < count; ++i) {
    more.push_back(more[i]);
    more.back().position.x() += 1000;
  }
  prior.index = LayoutIndex(more, 50, 2);
  ASSERT_GT(prior.index.pose_volume(), 1.5 * volume);
  EXPECT_NEAR(prior.Level(0, Vec3::Zero()) - before, std::log(prior.index.pose_volume() / volume),
              1e-9);
}

TEST(OdometryPrior, ALoopNarrowsIt) {
  Prior prior;
  OdometryModel poor;
  poor.factors = {5, 5, 5, 5};
  prior.CloseLoops({}, poor);
  const double near = prior.Level(0, Vec3::Zero()), far = prior.Level(0, Vec3(20, 0, 0)),
               rise = prior.Height(3);
  LoopClosure closure;
  closure.covariance *= 1e-4;
  const int match = 30, query = prior.here;
  prior.CloseLoops({{match, query, &closure}}, poor);
  EXPECT_GT(prior.Level(0, Vec3::Zero()), near + 1);
  EXPECT_LT(prior.Level(0, Vec3(20, 0, 0)), far - 1);
  EXPECT_LT(prior.Height(3), rise - 0.5);
}

TEST(OdometryPrior, PoorerOdometryForgivesMore) {
  Prior prior;
  const double far = prior.Level(0, Vec3(20, 0, 0)), turned = prior.Level(0.5, Vec3::Zero()),
               risen = prior.Height(3);
  OdometryModel poor;
  poor.factors = {5, 5, 5, 5};
  prior.CloseLoops({}, poor);
  EXPECT_GT(prior.Level(0, Vec3(20, 0, 0)), far + 1);
  EXPECT_GT(prior.Level(0.5, Vec3::Zero()), turned + 1);
  EXPECT_GT(prior.Height(3), risen + 1);
}

TEST(OdometryPrior, AHeightOnlyRefutes) {
  Prior prior;
  EXPECT_EQ(prior.Height(0), 0);
  double before = 0;
  for (const double metres : {0.5, 2., 5., 20.}) {
    const double now = prior.Height(metres);
    EXPECT_LT(now, before) << metres;
    EXPECT_NEAR(prior.Height(-metres), now, 1e-9) << "up and down";
    before = now;
  }
  EXPECT_NEAR(prior.Of(0.3, Vec3(20, 0, 0)).height, 0, 1e-9) << "whatever the pose";
}

TEST(OdometryPrior, TheHeightOfALoopIsThatOfItsCamera) {
  Prior prior;
  const OdometryPrior odometry = prior.Odometry();
  LoopMeasurement loop;
  loop.match = 30;
  loop.query = prior.here;
  const auto of = [&](const Vec3& shift) {
    loop.row.T_match_query = Pose::Trans(shift) * prior.world.TrueLoop(loop.match, loop.query);
    return odometry.OfHeight(loop);
  };
  EXPECT_NEAR(of({0, 0, 0}), 0, 1e-9);
  EXPECT_NEAR(of({30, 0, -20}), 0, 1e-9) << "horizontal";
  EXPECT_LT(of({0, 3, 0}), -3) << "the first camera's y is down";
  EXPECT_NEAR(of({0, 3, 0}), of({0, -3, 0}), 1e-9);
  EXPECT_NEAR(of({0, -3, 0}), prior.Height(3), 0.3) << "as that of its objects";
}

TEST(OdometryPrior, RankPutsThePosesNextToTheTrajectoryFirst) {
  const Prior prior;
  const OdometryPrior odometry = prior.Odometry();
  const auto rank = [&](double turn, const Vec3& shift) {
    return odometry.Rank(prior.Moved(turn, shift));
  };
  EXPECT_EQ(odometry.Rank({}), 0);
  double before = 0;
  for (const double metres : {1., 5., 20., 80.}) {
    EXPECT_LT(rank(0, Vec3(metres, 0, 0)), before);
    before = rank(0, Vec3(metres, 0, 0));
  }
  EXPECT_GT(rank(0.1, Vec3::Zero()), rank(0.5, Vec3::Zero()));
  EXPECT_GT(rank(-0.5, Vec3::Zero()), rank(2, Vec3::Zero()));
}

// Three standard deviations of where the map is least certain.
TEST(OdometryPrior, TheLargestRiseHoldsForTheWholePath) {
  Prior prior;
  const double rise = prior.Odometry().LargestRise();
  EXPECT_GE(rise, 3 * 0.5) << "that of the layouts themselves";
  OdometryModel poor;
  poor.factors.vertical = 10;
  prior.CloseLoops({}, poor);
  EXPECT_GT(prior.Odometry().LargestRise(), 1.5 * rise);
  prior.here = 0;
  EXPECT_NEAR(prior.Odometry().LargestRise(), 3 * 0.5, 1e-9) << "no path";
}

TEST(OdometryPrior, NoMatchNoOpinion) {
  Prior prior;
  prior.fit.matches.clear();
  const PosePrior nothing = prior.Odometry().Of({0, Vec3(500, 0, 0)}, prior.fit);
  EXPECT_EQ(nothing.level, 0);
  EXPECT_EQ(nothing.height, 0);
}

TEST(OdometryPrior, SaysNothingWhereOdometryWasLost) {
  Prior prior;
  FrameStore frames(100);
  const int lost = TwoPasses::kSecond - 5;
  for (int i = 0; i < prior.world.state.frames.size(); ++i)
    frames.Append(prior.world.state.frames[i],
                  i == lost ? std::optional(StepUncertainty{true}) : std::nullopt);
  prior.world.state.frames = frames;
  prior.CloseLoops({});
  for (const double metres : {0., 50., 1000.}) {
    EXPECT_EQ(prior.Of(2, Vec3(metres, 0, 0)).level, 0);
    EXPECT_EQ(prior.Height(metres), 0);
  }
  LoopMeasurement loop;
  loop.match = 30;
  loop.query = prior.here;
  loop.row.T_match_query = Pose::Trans(0, 50, 0);
  EXPECT_EQ(prior.Odometry().OfHeight(loop), 0);
  EXPECT_GT(prior.Odometry().LargestRise(), 50);

  LoopClosure closure;
  closure.covariance *= 1e-4;
  prior.CloseLoops({{30, prior.here, &closure}});
  EXPECT_GT(prior.Level(0, Vec3::Zero()), 3);
  EXPECT_LT(prior.Level(0, Vec3(50, 0, 0)), -3);
  EXPECT_LT(prior.Odometry().OfHeight(loop), -3);
}

}  // namespace
}  // namespace sslcd
