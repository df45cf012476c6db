// SPDX-License-Identifier: BSD-3-Clause
#include "eval/kitti_ground_truth.h"

#include <gtest/gtest.h>

#include "outside.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr const char* kCar = "3 7 Car 0 0 -1.5 100 120 200 220 1.5 1.6 4.0 2.0 1.8 20.0 0.5\n";

class GroundTruthReader : public ::testing::Test {
 protected:
  std::string File(const std::string& text) {
    return outside::WriteFile(folder_.path() / "0001.txt", text).string();
  }

  void ExpectError(const std::string& text, const std::string& part) {
    try {
      ReadKittiTrackingLabels(File(text));
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  }

  outside::TempDir folder_;
};

TEST_F(GroundTruthReader, ReadsBoxesAtTheirCentre) {
  const auto boxes = ReadKittiTrackingLabels(File(
      std::string("0 -1 DontCare -1 -1 -10 1 2 3 4 -1000 -1000 -1000 -10 -1 -1 -1\r\n\n") + kCar));
  ASSERT_EQ(boxes.size(), 1u);
  const GroundTruthBox& car = boxes[0];
  EXPECT_EQ(car.frame, 3);
  EXPECT_EQ(car.track, 7);
  EXPECT_EQ(car.label, "Car");
  EXPECT_EQ(car.dims, Vec3(4.0, 1.6, 1.5));
  EXPECT_LT((car.T_cam_object.translation() - Vec3(2.0, 1.05, 20.0)).norm(), 1e-12);
  EXPECT_LT(
      (car.T_cam_object.so3() * Vec3(1, 0, 0) - Vec3(std::cos(0.5), 0, -std::sin(0.5))).norm(),
      1e-12);
  EXPECT_LT((car.T_cam_object.so3() * Vec3(0, 0, 1) - Vec3(0, -1, 0)).norm(), 1e-12);
}

TEST_F(GroundTruthReader, BadRowsAreNamedByLine) {
  ExpectError(std::string(kCar) + "3 7 Car 0 0\n", "0001.txt:2");
  ExpectError("3 7 Car 0 0 -1.5 100 120 200 220 1.5 1.6 4.0 2.0 1.8x 20.0 0.5\n", "'1.8x'");
  ExpectError("3 7 Car 0 0 -1.5 100 120 200 220 1.5 1.6 nan 2.0 1.8 20.0 0.5\n", "not finite");
  ExpectError("3.5 7 Car 0 0 -1.5 100 120 200 220 1.5 1.6 4.0 2.0 1.8 20.0 0.5\n", "whole number");
  ExpectError("-3 7 Car 0 0 -1.5 100 120 200 220 1.5 1.6 4.0 2.0 1.8 20.0 0.5\n", "negative");
  EXPECT_THROW(ReadKittiTrackingLabels((folder_.path() / "none.txt").string()), Error);
  EXPECT_THROW(ReadKittiTrackingLabels(folder_.path().string()), Error);
  EXPECT_TRUE(ReadKittiTrackingLabels(File("")).empty());
}

TEST_F(GroundTruthReader, LandmarkIds) {
  EXPECT_EQ(ReadLandmarkIds(File("5\n-1\r\n\n12")), (std::vector<int>{5, -1, 12}));
  EXPECT_THROW(ReadLandmarkIds(File("5 6\n")), Error);
  EXPECT_THROW(ReadLandmarkIds(File("5.5\n")), Error);
}

TEST_F(GroundTruthReader, RealLabels) {
  const auto labels = outside::DataDir() / "kitti-tracking/label_02/0007.txt";
  if (!outside::fs::exists(labels)) GTEST_SKIP() << "skipped: no data";
  const auto boxes = ReadKittiTrackingLabels(labels.string());
  EXPECT_GT(boxes.size(), 2000u);
  for (const GroundTruthBox& box : boxes) EXPECT_GT(box.dims.minCoeff(), 0);
}

}  // namespace
}  // namespace sslcd
