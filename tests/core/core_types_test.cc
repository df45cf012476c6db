// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/error.h"
#include "sslcd/core/image.h"
#include "sslcd/core/label.h"
#include "sslcd/core/log.h"
#include "sslcd/core/pose.h"

namespace sslcd {
namespace {

TEST(WrapAngle, StaysInRangeAndKeepsTheDirection) {
  for (double angle = -20; angle < 20; angle += 0.37) {
    const double wrapped = WrapAngle(angle);
    EXPECT_GT(wrapped, -M_PI);
    EXPECT_LE(wrapped, M_PI);
    EXPECT_NEAR(std::cos(wrapped - angle), 1., 1e-12);
    EXPECT_LE(std::abs(WrapAngle(angle, M_PI)), M_PI / 2);
    EXPECT_NEAR(std::cos(2 * (WrapAngle(angle, M_PI) - angle)), 1., 1e-12);
  }
  EXPECT_EQ(WrapAngle(M_PI), M_PI);
  EXPECT_EQ(WrapAngle(-M_PI), M_PI);
  EXPECT_EQ(WrapAngle(1.4), 1.4);
}

TEST(GravityFrame, KittiAndVinsAxes) {
  const GravityFrame kitti = GravityFrame::FromUp(Vec3(0, -2, 0));
  EXPECT_EQ(kitti.forward, Vec3(1, 0, 0));
  EXPECT_EQ(kitti.left, Vec3(0, 0, 1));
  const GravityFrame vins = GravityFrame::FromUp(Vec3(0, 0, 1));
  EXPECT_EQ(vins.forward, Vec3(1, 0, 0));
  EXPECT_EQ(vins.left, Vec3(0, 1, 0));
  EXPECT_EQ(GravityFrame().left, kitti.left) << "the default is KITTI's";
}

TEST(GravityFrame, UprightIsUprightAndYawComesBack) {
  for (const Vec3& up : {Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0.1, -0.9, 0.2)}) {
    const GravityFrame gravity = GravityFrame::FromUp(up);
    EXPECT_NEAR(gravity.Basis().determinant(), 1., 1e-12);
    for (double yaw = -3; yaw <= 3; yaw += 0.5) {
      const UprightPose pose{Vec3(1, 2, 3), yaw};
      const Pose T = ToPose(pose, gravity);
      EXPECT_LT((T.so3() * Vec3(0, 0, 1) - gravity.up).norm(), 1e-12);
      EXPECT_NEAR(ToUpright(T, gravity).yaw, yaw, 1e-12);
      EXPECT_EQ(ToUpright(T, gravity).position, pose.position);
    }
  }
}

TEST(Iou, BoxesOfTheImage) {
  const Box2d a{0, 0, 10, 10};
  EXPECT_EQ(Iou(a, a), 1.);
  EXPECT_NEAR(Iou(a, {5, 0, 15, 10}), 50. / 150., 1e-12);
  EXPECT_EQ(Iou(a, {10, 0, 20, 10}), 0.) << "touching";
  EXPECT_EQ(Iou(a, {5, 5, 5, 5}), 0.) << "empty";
  EXPECT_EQ(Iou(a, {8, 8, 2, 2}), 0.) << "inside out";
}

TEST(DetectionNoise, CovarianceFollowsTheRay) {
  const Vec3 point(3, 1, 20);
  const Eigen::Matrix3d rows = RayFrame(point);
  EXPECT_LT((rows * rows.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT((rows * point - Vec3(point.norm(), 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(rows(1, 1), 0, 1e-12) << "the second axis is horizontal";
  const DetectionSigmas sigmas{2., 0.5, 0.25, 1};
  const Eigen::Matrix3d covariance = PositionCovariance(point, sigmas);
  const Vec3 ray = point.normalized();
  EXPECT_NEAR(ray.dot(covariance * ray), 4., 1e-9);
  EXPECT_LT((PositionInformation(point, sigmas) * covariance - Eigen::Matrix3d::Identity()).norm(),
            1e-12);
  EXPECT_TRUE(RayFrame(Vec3(0, 5, 0)).allFinite()) << "straight down";
  EXPECT_TRUE(RayFrame(Vec3(0, 0, 0)).allFinite()) << "no range at all";
}

TEST(DetectionNoise, GrowsWithRangeAndScale) {
  const DetectionSigmas near = SigmasAt(10, {}, {}), far = SigmasAt(40, {}, {}),
                        noisy = SigmasAt(10, {}, {3, 1, 1, 2});
  EXPECT_GT(far.radial, near.radial);
  EXPECT_GT(far.yaw, near.yaw);
  EXPECT_NEAR(noisy.radial, 3 * near.radial, 1e-12);
  EXPECT_NEAR(noisy.yaw, 2 * near.yaw, 1e-12);
  EXPECT_EQ(noisy.lateral, near.lateral);
}

TEST(Label, SymmetriesAndUnknownLabels) {
  for (const Symmetry s : {Symmetry::kNone, Symmetry::kPi, Symmetry::kFull})
    EXPECT_EQ(ParseSymmetry(ToString(s)), s);
  EXPECT_FALSE(ParseSymmetry("Full"));
  EXPECT_EQ(YawPeriod(Symmetry::kFull), 0);
  LabelTable table;
  table.Set("Tree", {Symmetry::kFull});
  EXPECT_EQ(table["Tree"].symmetry, Symmetry::kFull);
  EXPECT_EQ(table["Car"].symmetry, Symmetry::kNone);
}

TEST(Image, OnesThatCannotBeReadAreRefused) {
  const unsigned char bytes[12] = {};
  EXPECT_NO_THROW(CheckImage({bytes, 2, 2, 6, 3}, "image"));
  EXPECT_NO_THROW(CheckImage({bytes, 2, 2, 2, 1}, "image"));
  EXPECT_THROW(CheckImage({}, "image"), Error);
  EXPECT_THROW(CheckImage({bytes, 2, 2, 5, 3}, "image"), Error);
  EXPECT_THROW(CheckImage({bytes, 1, 2, 4, 4}, "image"), Error);
  EXPECT_NO_THROW(CheckImages({{bytes, 2, 2, 2, 1}, {bytes, 2, 2, 6, 3}}));
  EXPECT_THROW(CheckImages({{bytes, 2, 2, 2, 1}, {bytes, 2, 1, 2, 1}}), Error);
}

TEST(Image, ViewIsOfItsOwnPixels) {
  for (const int channels : {1, 3}) {
    const Image image{std::vector<unsigned char>(static_cast<std::size_t>(4 * 2 * channels), 7), 4,
                      2, channels};
    EXPECT_FALSE(image.empty());
    const ImageView view = image.view();
    EXPECT_EQ(view.data, image.pixels.data());
    EXPECT_EQ(view.width, 4);
    EXPECT_EQ(view.height, 2);
    EXPECT_EQ(view.channels, channels);
    EXPECT_EQ(view.stride * 2, image.pixels.size()) << "no gaps between rows";
    EXPECT_NO_THROW(CheckImage(view, "image"));
  }
  EXPECT_TRUE(Image().empty());
  EXPECT_THROW(CheckImage(Image().view(), "image"), Error);
}

TEST(StereoCamera, HasABaseline) {
  const Camera left{700, 700, 600, 180, {0.06, 0, 0}, 1242, 375};
  Camera right = left;
  right.offset.x() = -0.48;
  EXPECT_NEAR(MakeStereoCamera(left, right).baseline_m, 0.54, 1e-12);
  EXPECT_THROW(MakeStereoCamera(right, left), Error);
  EXPECT_THROW(MakeStereoCamera(left, left), Error);
  right.cx = 602.5;
  const StereoCamera shifted = MakeStereoCamera(left, right);
  EXPECT_NEAR(shifted.disparity_at_infinity, -2.5, 1e-12);
  EXPECT_EQ(RightOf(shifted).cx, 602.5);
  EXPECT_NEAR(RightOf(shifted).offset.x(), -0.48, 1e-12);
  right.cx = 603.5;
  EXPECT_THROW(MakeStereoCamera(left, right), Error)
      << "another rectification, not an error of calibration";
  right = RightOf(shifted);
  right.fx = 710;
  EXPECT_THROW(MakeStereoCamera(left, right), Error);
}

TEST(Error, SaysWhereAndWhat) {
  EXPECT_STREQ(Error(ErrorKind::kBadInput, {"a.txt", 3, 5}, "bad").what(), "a.txt:3:5: bad");
  EXPECT_STREQ(Error(ErrorKind::kBadInput, {"a.txt", 0, 5}, "bad").what(), "a.txt: bad");
  EXPECT_EQ(Error(ErrorKind::kBadConfig, "x").kind(), ErrorKind::kBadConfig);
}

TEST(Log, IsSilentUntilAHostListens) {
  Log(LogLevel::kError, "nobody hears this");
  std::string heard;
  const LogSink before =
      SetLogSink([&](LogLevel, const std::string& message) { heard += message; });
  Log(LogLevel::kInfo, "this");
  SetLogSink(before);
  Log(LogLevel::kInfo, "not this");
  EXPECT_EQ(heard, "this");
}

}  // namespace
}  // namespace sslcd
