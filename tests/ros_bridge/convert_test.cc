// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/convert.h"

#include <gtest/gtest.h>

#include <limits>

namespace sslcd::ros_bridge {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ToPose, TakesXyzw) {
  const auto pose = ToPose({{1, 2, 3}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}});
  ASSERT_TRUE(pose);
  EXPECT_LT(((*pose) * Vec3(1, 0, 0) - Vec3(1, 3, 3)).norm(), 1e-12);
}

TEST(ToPose, NormalisesAndRefuses) {
  EXPECT_TRUE(ToPose({{}, {0, 0, 0, 1.009}}));
  EXPECT_NEAR(ToPose({{}, {0, 0, 0, 1.009}})->so3().matrix().determinant(), 1, 1e-12);
  EXPECT_FALSE(ToPose({{}, {0, 0, 0, 1.02}}));
  EXPECT_FALSE(ToPose({{}, {0, 0, 0, 0}})) << "of no length";
  EXPECT_FALSE(ToPose({{}, {0, 0, kNan, 1}}));
  EXPECT_FALSE(ToPose({{}, {0, 0, 0, kInfinity}}));
  EXPECT_FALSE(ToPose({{0, kNan, 0}, {0, 0, 0, 1}}));
  EXPECT_FALSE(ToPose({{0, 0, -kInfinity}, {0, 0, 0, 1}}));
}

TEST(QualityOf, LostIsBothOfXAndY) {
  OdometryMessage odometry;
  EXPECT_EQ(QualityOf(odometry, 9999), OdometryQuality::kGood);
  odometry.covariance[0] = 9999;
  odometry.covariance[14] = 1e6;  // z: wheels
  EXPECT_EQ(QualityOf(odometry, 9999), OdometryQuality::kGood);
  odometry.covariance[7] = 9999;
  EXPECT_EQ(QualityOf(odometry, 9999), OdometryQuality::kLost);
  EXPECT_EQ(QualityOf(odometry, kInfinity), OdometryQuality::kGood);
}

TEST(QualityOf, VariancesAreFiniteAndNotNegative) {
  for (const double bad : {kNan, kInfinity, -1.}) {
    for (const std::size_t i : {0u, 7u, 35u}) {
      OdometryMessage odometry;
      odometry.covariance[i] = bad;
      EXPECT_EQ(QualityOf(odometry, 9999), OdometryQuality::kBadCovariance);
    }
  }
}

DetectionMessage Car() { return {{{"Car", 0.9}}, {{1, 2, 10}, {0, 0, 0, 1}}, {4, 1.8, 1.5}}; }

TEST(ToDetection, TakesTheMostProbableHypothesis) {
  DetectionMessage message = Car();
  message.hypotheses = {{"Van", 0.3}, {"Car", 0.6}, {"Truck", 0.1}};
  const auto detection = ToDetection(message, Pose::Trans(0, 0, 5));
  ASSERT_TRUE(detection);
  EXPECT_EQ(detection->label, "Car");
  EXPECT_EQ(detection->score, 0.6);
  EXPECT_EQ(detection->dims, Vec3(4, 1.8, 1.5));
  EXPECT_LT((detection->T_cam_object.translation() - Vec3(1, 2, 15)).norm(), 1e-12);
}

TEST(ToDetection, RefusesWhatIsUnusable) {
  EXPECT_TRUE(ToDetection(Car(), {}));
  DetectionMessage message = Car();
  message.hypotheses.clear();
  EXPECT_FALSE(ToDetection(message, {}));
  for (const Hypothesis& bad : {Hypothesis{"", 0.9}, Hypothesis{"Car", 1.1},
                                Hypothesis{"Car", kNan}, Hypothesis{"Car", -0.1}}) {
    message = Car();
    message.hypotheses = {bad};
    EXPECT_FALSE(ToDetection(message, {})) << bad.label << bad.score;
  }
  for (const double bad : {0., -1., kNan, kInfinity}) {
    message = Car();
    message.size[2] = bad;
    EXPECT_FALSE(ToDetection(message, {})) << bad;
  }
  message = Car();
  message.pose.orientation = {0, 0, 0, 0};
  EXPECT_FALSE(ToDetection(message, {}));
}

// The camera is turned and off the base; a small error of the camera's pose is the same error of
// the base's.
TEST(BetweenBases, MovesPoseAndCovariance) {
  const Pose T_base_cam = Pose::Trans(0.5, -0.2, 1) * Pose::RotX(-1.2) * Pose::RotY(0.7);
  LoopClosure loop;
  loop.T_match_query = Pose::Trans(1, 2, 3) * Pose::RotZ(2);
  loop.covariance.diagonal() << 0.1, 0.2, 0.3, 0.01, 0.02, 0.03;
  const RelativePose bases = BetweenBases(loop, T_base_cam);
  EXPECT_LT(
      ((bases.T_a_b * T_base_cam).matrix() - (T_base_cam * loop.T_match_query).matrix()).norm(),
      1e-12);
  Pose::Matrix6 expected = Pose::Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    Pose::Tangent d = Pose::Tangent::Zero();
    d(i) = 1e-6;
    const Pose moved = T_base_cam * loop.T_match_query * Pose::Exp(d) * T_base_cam.inverse();
    const Pose::Tangent error = (bases.T_a_b.inverse() * moved).Log() / 1e-6;
    expected += loop.covariance(i, i) * error * error.transpose();
  }
  EXPECT_LT((bases.covariance - expected).norm(), 1e-5);
}

}  // namespace
}  // namespace sslcd::ros_bridge
