// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_prior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/median.h"
#include "two_passes.h"

namespace sslcd {
namespace {

// The second pass of a grove against the first one. Both coordinates agree: no drift.
struct Prior {
  TwoPasses world;
  PassLayouts::Mark mark;
  LayoutIndex index{PassLayouts(world.passes, world.state).ChangesBefore(100, 2, mark).objects, 50,
                    2};
  PassLayout local = PassLayouts(world.passes, world.state).Recent(world.end_m() - 60, 2);
  LoopPriorOptions options;
  PathGraph path;
  LayoutFit fit = Matches();

  // All trees: of the second pass, of the first.
  LayoutFit Matches() const {
    LayoutFit matches;
    for (std::size_t i = 0; i < local.objects.size(); ++i)
      for (std::size_t j = 0; j < index.objects().size(); ++j)
        if ((local.objects[i].position - index.objects()[j].position).norm() < 0.1)
          matches.matches.emplace_back(i, j);
    return matches;
  }

  // Log odds of a turn about the objects' centre, and a shift.
  double Of(double turn_rad, const Vec3& shift) const {
    Vec3 centre = Vec3::Zero();
    for (const auto& [i, j] : fit.matches)
      centre += local.objects[i].position / static_cast<double>(fit.matches.size());
    YawShift pose{turn_rad, Vec3::Zero()};
    pose.t = centre + shift - Apply(pose, centre);
    const PathGraph::Distances distances = path.From(world.end_m());
    return OdometryPrior(world.passes, distances, local, index, options)(pose, fit);
  }
};

TEST(OdometryPrior, FallsWithEveryMetreAndEveryTurn) {
  const Prior prior;
  ASSERT_GE(prior.fit.matches.size(), 15u);
  EXPECT_GT(prior.Of(0, Vec3::Zero()), prior.Of(0, Vec3(20, 0, 0)));
  EXPECT_GT(prior.Of(0, Vec3(20, 0, 0)), prior.Of(0, Vec3(80, 0, 0)));
  EXPECT_GT(prior.Of(0, Vec3::Zero()), prior.Of(0.5, Vec3::Zero()));
  EXPECT_GT(prior.Of(0.5, Vec3::Zero()), prior.Of(1, Vec3::Zero()));
}

TEST(OdometryPrior, IsTheSameInAllDirectionsAndSaysNothingOfHeight) {
  const Prior prior;
  EXPECT_NEAR(prior.Of(0, Vec3(20, 0, 0)), prior.Of(0, Vec3(0, -20, 0)), 1e-9);
  EXPECT_NEAR(prior.Of(0.5, Vec3::Zero()), prior.Of(-0.5, Vec3::Zero()), 1e-9);
  EXPECT_NEAR(prior.Of(2 * M_PI, Vec3::Zero()), prior.Of(0, Vec3::Zero()), 1e-9);
  EXPECT_NEAR(prior.Of(0, Vec3(0, 0, 30)), prior.Of(0, Vec3::Zero()), 1e-9);
}

TEST(OdometryPrior, TheShareOfSurprisesIsLeftForThePosesThatOdometryExcludes) {
  Prior prior;
  EXPECT_NEAR(prior.Of(0, Vec3(1e5, 0, 0)), std::log(prior.options.surprise), 1e-6);
  prior.options.surprise = 1;
  EXPECT_NEAR(prior.Of(0, Vec3::Zero()), 0, 1e-9) << "odometry says nothing";
}

TEST(OdometryPrior, AShortcutNarrowsIt) {
  Prior prior;
  const double near = prior.Of(0, Vec3::Zero()), far = prior.Of(0, Vec3(60, 0, 0));
  prior.path.AddShortcut(prior.world.end_m() - 5, 30);
  EXPECT_GT(prior.Of(0, Vec3::Zero()), near + 1);
  EXPECT_LT(prior.Of(0, Vec3(60, 0, 0)), far - 1);
}

// sigma = share of the path (1 m at its start), and the yaw's walk over the path's lever.
TEST(OdometryPrior, AGaussianWhoseWidthsGrowWithThePath) {
  Prior prior;
  prior.options.surprise = 0;
  std::vector<double> paths;
  for (const auto& [i, j] : prior.fit.matches) {
    const int pass = prior.world.passes.PassesOf({prior.index.objects()[j].id}).front();
    paths.push_back(prior.world.end_m() - prior.world.passes.passes()[pass].last_m);
  }
  const double path = Median(paths);
  const double yaw = std::hypot(0.02, prior.options.drift_yaw * std::sqrt(path));
  const double m = std::hypot(1., prior.options.drift_share * path, yaw * path / std::sqrt(3.));
  const double here = prior.Of(0, Vec3::Zero());
  EXPECT_NEAR(here - prior.Of(0, Vec3(m, 0, 0)), 0.5, 1e-6);
  EXPECT_NEAR(here - prior.Of(2 * yaw, Vec3::Zero()), 2, 1e-6);
  const double density = 1 / (std::pow(2 * M_PI, 1.5) * m * m * yaw);
  EXPECT_NEAR(here, std::log(prior.index.pose_volume() * density), 1e-6);
}

TEST(OdometryPrior, NoMatchNoOpinion) {
  Prior prior;
  prior.fit.matches.clear();
  const PathGraph::Distances distances = prior.path.From(prior.world.end_m());
  EXPECT_EQ(OdometryPrior(prior.world.passes, distances, prior.local, prior.index, prior.options)(
                {0, Vec3(500, 0, 0)}, prior.fit),
            0);
}

}  // namespace
}  // namespace sslcd
