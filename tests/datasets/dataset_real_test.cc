// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>

#include "sslcd/datasets/dataset.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

TEST(RealData, KittiTracking0007) {
  SSLCD_REAL_DATA(folder, "kitti-tracking");
  DatasetRequest request;
  request.path = folder;
  request.sequence = "0007";
  request.detections = "det_pointrcnn_car";
  request.odometry = "orbslam3_poses/0007.txt";
  request.groundtruth = "oxts_cam0_poses";
  const auto start = std::chrono::steady_clock::now();
  const Dataset dataset = LoadDataset(request);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RecordProperty("load_ms", static_cast<int>(1e3 * seconds));
  EXPECT_LT(seconds, 1.) << "tens of milliseconds, here with room for sanitizers";

  EXPECT_EQ(dataset.frames.size(), 800u);
  EXPECT_EQ(dataset.groundtruth->size(), 800u);
  EXPECT_EQ(dataset.rows_read, 4219);
  EXPECT_EQ(dataset.rows_dropped + dataset.rows_beyond_end, 0);
  EXPECT_THAT(dataset.warnings, testing::IsEmpty());
  EXPECT_NEAR(dataset.camera->offset.x(), (44.85728 - 609.5593 * 2.745884e-3) / 721.5377, 1e-9);
  const Detection& first = dataset.frames[0].detections.at(0);
  EXPECT_NEAR(first.score, 1, 1e-5) << "14.08 is a logit";
  EXPECT_NEAR(first.T_cam_object.translation().y(), 1.7691 - 1.5146 / 2, 1e-9);
  int last_row = -1;
  for (const Frame& frame : dataset.frames) {
    for (const Detection& detection : frame.detections) EXPECT_EQ(detection.row, ++last_row);
  }
}

TEST(RealData, KittiTrackingSaysWhatThereIs) {
  SSLCD_REAL_DATA(folder, "kitti-tracking");
  DatasetRequest request;
  request.path = folder;
  request.sequence = "0007";
  ExpectError([&] { LoadDataset(request); }, {"orbslam3_poses/0007.txt"});
  request.odometry = "orbslam3_poses";
  ExpectError([&] { LoadDataset(request); },
              {"det_pointrcnn_car/0007.txt", "det_stereo_grade_car/0007.txt"});
  request.sequence = "0008";
  ExpectError([&] { LoadDataset(request); },
              {"no sequence '0008'", "0001, 0005, 0007, 0009, 0011"});
}

TEST(RealData, VictoriaPark) {
  SSLCD_REAL_DATA(folder, "victoria-park");
  DatasetRequest request;
  request.path = folder;
  const Dataset dataset = LoadDataset(request);
  EXPECT_EQ(dataset.frames.size(), 7120u);
  EXPECT_EQ(dataset.rows_read, 3640);
  EXPECT_EQ(dataset.labels["Tree"].symmetry, Symmetry::kFull);
  EXPECT_FALSE(dataset.camera.has_value());
  EXPECT_FALSE(dataset.groundtruth.has_value()) << "reference.txt is for the judge";
  EXPECT_FALSE(dataset.frames[4].detections.at(0).box.has_value());
  EXPECT_EQ(dataset.frames[4].detections[0].score, 0.9);
}

TEST(RealData, KittiOdometryPoles) {
  SSLCD_REAL_DATA(folder, "kitti-odometry-poles");
  DatasetRequest request;
  request.path = folder;
  request.sequence = "00";
  const Dataset dataset = LoadDataset(request);
  EXPECT_EQ(dataset.name, "00");
  EXPECT_EQ(dataset.frames.size(), 2271u);
  EXPECT_EQ(dataset.groundtruth->size(), 2271u);
  EXPECT_EQ(dataset.rows_read, 6307);
  EXPECT_EQ(dataset.camera->fx, 718.856);
}

TEST(RealData, SlamEstimatesOfOthers) {
  SSLCD_REAL_DATA(folder, "kitti-00-slam-estimates");
  for (const char* name : {"/KITTI_00_ORB.txt", "/KITTI_00_SPTAM.txt"}) {
    EXPECT_EQ(ReadPoseFile(folder + name).format, PoseFormat::kKitti);
  }
}

}  // namespace
}  // namespace sslcd
