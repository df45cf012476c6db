// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/ground/ground_alignment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sslcd/core/error.h"
#include "stereo/stereo_scene.h"

namespace sslcd {
namespace {

/// Two cameras that look at the ground 7 m ahead of both, the second one turned by `turn_deg` about
/// that.
struct TwoViews {
  StereoScene a, b;
  Pose T_a_b;

  explicit TwoViews(double turn_deg) {
    a.camera.disparity_at_infinity = b.camera.disparity_at_infinity = -1.7;
    const Pose spot = Pose::Trans(0.3, 0, 7);
    T_a_b = spot * Pose::RotY(turn_deg * M_PI / 180) * Pose::Trans(0.2, 0, -7);
    b.T_scene_cam = T_a_b;
  }
  std::optional<RelativePose> Align(const Pose& guess,
                                    const GroundAlignmentOptions& options = {}) const {
    return AlignGround(a.view(), b.view(), a.camera, guess, {}, options);
  }
};

const Vec6 kOff = (Vec6() << 0.3, 0.02, -0.25, 0.003, 0.012, -0.004).finished();

class AlignGroundFrom : public testing::TestWithParam<double> {};

TEST_P(AlignGroundFrom, FindsTheOtherCamera) {
  TwoViews views(GetParam());
  views.a.Render();
  views.b.Render();
  const auto found = views.Align(views.T_a_b * Pose::Exp(kOff));
  ASSERT_TRUE(found);
  const Vec6 error = (views.T_a_b.inverse() * found->T_a_b).Log();
  EXPECT_LT(error.head<3>().norm(), 0.02) << error.transpose();
  EXPECT_LT(error.tail<3>().norm(), 0.002) << error.transpose();
  const Pose::Matrix6 covariance = found->covariance;
  EXPECT_TRUE(covariance.isApprox(covariance.transpose(), 1e-9));
  EXPECT_LT(error.dot(Vec6(covariance.inverse() * error)) / 6, 3) << "not surer than it may be";
  EXPECT_LT(std::sqrt(covariance.topLeftCorner<3, 3>().trace()), 0.02) << "and not much less sure";
}
INSTANTIATE_TEST_SUITE_P(Degrees, AlignGroundFrom, testing::Values(0., 90., 180.));

TEST_P(AlignGroundFrom, FindsItFromAGuessToTheCentimetre) {
  TwoViews views(GetParam());
  views.a.Render();
  views.b.Render();
  const auto found = views.Align(views.T_a_b * Pose::Exp(Vec6(0.1 * kOff)));
  ASSERT_TRUE(found);
  EXPECT_LT((views.T_a_b.inverse() * found->T_a_b).Log().norm(), 0.02);
}

TEST(AlignmentRange, IsWhereBothCamerasSeeEnough) {
  Camera camera{500, 500, 320, 240, {}, 0, 0};
  const double nearest = 1.5 * 500 / 240;
  const double spot = AlignmentRange(camera, 480, 1.5).value();
  EXPECT_GT(spot, nearest + 2) << "that of the one 2 m nearer, that of the other beyond";
  EXPECT_LT(spot, nearest + 5);
  EXPECT_GT(AlignmentRange(camera, 400, 1.5).value(), spot) << "sees less of what is near";
  EXPECT_FALSE(AlignmentRange(camera, 240, 1.5)) << "only sky";
  EXPECT_FALSE(AlignmentRange(camera, 480, 10)) << "on a roof";
}

TEST(AlignGround, ThroughACarInTheWayAndAnotherLight) {
  TwoViews views(180);
  views.b.Add(-2.5, 6.5, 1.2, {4, 1.8, 1.5});  // came since
  views.a.Render();
  views.b.Render();
  views.b.left = 0.7 * views.b.left + 20;
  views.b.right = 0.7 * views.b.right + 20;
  const auto found = views.Align(views.T_a_b * Pose::Exp(kOff));
  ASSERT_TRUE(found);
  EXPECT_LT((views.T_a_b.inverse() * found->T_a_b).Log().norm(), 0.1);
}

TEST(AlignGround, NothingAtAnotherPlace) {
  TwoViews views(180);
  views.b.ground_seed = 1234;
  views.a.Render();
  views.b.Render();
  EXPECT_FALSE(views.Align(views.T_a_b));
}

TEST(AlignGround, NothingFromAGuessTooFarOff) {
  TwoViews views(180);
  views.a.Render();
  views.b.Render();
  EXPECT_FALSE(views.Align(views.T_a_b * Pose::Trans(2, 0, 0)));
  EXPECT_FALSE(views.Align(views.T_a_b * Pose::Trans(0, 0, 40))) << "no common ground";
}

TEST(AlignGround, NothingWithoutTexture) {
  TwoViews views(180);
  views.a.texture = views.b.texture = false;
  views.a.Render();
  views.b.Render();
  EXPECT_FALSE(views.Align(views.T_a_b));
}

TEST(AlignGround, OnlyAsSureAsAskedFor) {
  TwoViews views(180);
  views.a.Render();
  views.b.Render();
  GroundAlignmentOptions options;
  options.max_sigma_m = 1e-4;
  EXPECT_FALSE(views.Align(views.T_a_b, options));
}

// KITTI's reference camera is beside the left one.
TEST(AlignGround, SpeaksOfTheReferenceCameras) {
  TwoViews views(90);
  views.a.Render();
  views.b.Render();
  views.a.camera.left.offset = Vec3(0.06, 0, 0);
  const Pose T_left_ref = Pose::Trans(0.06, 0, 0);
  const Pose truth = T_left_ref.inverse() * views.T_a_b * T_left_ref;
  const auto found = views.Align(truth * Pose::Exp(kOff));
  ASSERT_TRUE(found);
  EXPECT_LT((truth.inverse() * found->T_a_b).Log().norm(), 0.06);
}

TEST(AlignGround, NoPair) {
  TwoViews views(0);
  views.a.Render();
  views.b.Render();
  views.b.right = views.b.right.colRange(0, 600).clone();
  EXPECT_THROW(views.Align(views.T_a_b), Error);
}

}  // namespace
}  // namespace sslcd
