// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/datasets/dataset.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

using testing::Contains;
using testing::HasSubstr;

const char kCalib[] =
    "P2: 700 0 600 0 0 700 180 0 0 0 1 0\nTr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0\nR0_rect: 1 0 "
    "0 0 1 0 0 0 1\n"
    "Tr_imu_to_velo: 1 0 0 0 0 1 0 0 0 0 1 0\n";
const char kPoses[] = "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n";
const char kCsv[] = "1,2,10,20,30,40,2.5,1.5,2,4,1,2,10,0,0\n";

std::string Packet(double altitude) {
  std::string packet = "49 8 " + std::to_string(altitude) + " 0 0 0";
  for (int i = 0; i < 24; ++i) packet += " 0";
  return packet + "\n";
}

DatasetRequest Request(const std::string& path, const std::string& sequence = "") {
  DatasetRequest request;
  request.path = path;
  request.sequence = sequence;
  return request;
}

TEST(KittiTracking, LoadsWhatTheRequestNames) {
  const TempFolder folder;
  folder.Write("calib/0007.txt", kCalib);
  folder.Write("calib/0009.txt", kCalib);
  folder.Write("label_02/0007.txt", "never read");
  folder.Write("boxes/0007.txt", kCsv);
  folder.Write("slam/0007.txt", kPoses);
  folder.Write("oxts/0007.txt", Packet(100) + Packet(102));
  DatasetRequest request = Request(folder.path());
  ExpectError([&] { LoadDataset(request); }, {"name a sequence", "0007, 0009"});
  request.sequence = "07";
  ExpectError([&] { LoadDataset(request); }, {"no sequence '07'", "0007, 0009"});
  request.sequence = "0007";
  ExpectError([&] { LoadDataset(request); }, {"no odometry", "there are: slam/0007.txt"});
  request.odometry = "slam";
  ExpectError([&] { LoadDataset(request); }, {"no detections", "there are: boxes/0007.txt"});
  folder.Write("others/0009.txt", kCsv);
  request.detections = "others";
  ExpectError([&] { LoadDataset(request); }, {"others: has no 0007.txt", "there are: 0009.txt"});
  request.detections = "boxes/0007.txt";
  const Dataset dataset = LoadDataset(request);
  EXPECT_EQ(dataset.format, "kitti-tracking");
  EXPECT_EQ(dataset.groundtruth_boxes_path, folder.path() + "/label_02/0007.txt");
  EXPECT_EQ(dataset.name, "0007");
  ASSERT_EQ(dataset.frames.size(), 2u);
  EXPECT_NEAR(dataset.frames[1].stamp, 0.1, 1e-12);
  EXPECT_EQ(dataset.frames[1].detections.at(0).label, "Car");
  EXPECT_EQ(dataset.camera->width, 1242);
  ASSERT_TRUE(dataset.groundtruth.has_value());
  EXPECT_LT((dataset.groundtruth->poses.at(1).translation() - Vec3(0, -2, 0)).norm(), 1e-9)
      << "two metres up";
}

TEST(KittiTracking, PathsMayBeRelativeToTheCurrentFolder) {
  const TempFolder folder, elsewhere;
  folder.Write("label_02/0000.txt", "");
  DatasetRequest request = Request(folder.path());
  request.odometry = elsewhere.Write("poses.txt", kPoses);
  request.detections = elsewhere.Write("boxes.csv", kCsv);
  request.groundtruth = elsewhere.Write("truth.txt", std::string(kPoses) + kPoses);
  const Dataset dataset = LoadDataset(request);
  EXPECT_FALSE(dataset.camera.has_value()) << "no calibration is needed";
  EXPECT_EQ(dataset.groundtruth_path, request.groundtruth);
  EXPECT_EQ(dataset.groundtruth->size(), 2u);
  EXPECT_THAT(dataset.warnings, Contains(HasSubstr("4 ground-truth poses for 2 frames")));
}

TEST(KittiTracking, PacketsWithoutCalibrationAreNoGroundTruth) {
  const TempFolder folder;
  folder.Write("label_02/0000.txt", "");
  folder.Write("oxts/0000.txt", Packet(1) + Packet(2));
  DatasetRequest request = Request(folder.path());
  request.odometry = folder.Write("poses.txt", kPoses);
  request.detections = folder.Write("boxes.csv", kCsv);
  const Dataset dataset = LoadDataset(request);
  EXPECT_FALSE(dataset.groundtruth.has_value());
  EXPECT_THAT(dataset.warnings, Contains(HasSubstr("not used as ground truth")));
  request.groundtruth = "oxts";
  ExpectError([&] { LoadDataset(request); }, {"lacks the transform from IMU to camera"});
}

TEST(KittiOdometry, FindsSequencesAndPoses) {
  const TempFolder folder;
  folder.Write("sequences/00/calib.txt", kCalib);
  folder.Write("sequences/00/times.txt", "0\n0.1\n");
  folder.Write("sequences/01/times.txt", "0\n0.1\n");
  folder.Write("poses/00.txt", kPoses);
  DatasetRequest request = Request(folder.path(), "00");
  ExpectError([&] { LoadDataset(request); }, {"no odometry"});
  request.odometry = folder.Write("slam.txt", kPoses);
  request.detections = folder.Write("boxes.csv", kCsv);
  const Dataset dataset = LoadDataset(request);
  EXPECT_EQ(dataset.format, "kitti-odometry");
  EXPECT_EQ(dataset.name, "00");
  EXPECT_EQ(dataset.groundtruth->size(), 2u);
  EXPECT_EQ(dataset.camera->fx, 700);
  request.sequence = "0";
  ExpectError([&] { LoadDataset(request); }, {"no sequence '0'", "00, 01"});
}

/// A raw drive of two frames and one tracklet.
class RawDrive : public testing::Test {
 protected:
  RawDrive() {
    folder_.Write("day/calib_cam_to_cam.txt",
                  "P_rect_02: 700 0 600 0 0 700 180 0 0 0 1 0\nS_rect_02: 1242 375\n");
    folder_.Write("day/calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 0\n");
    folder_.Write("day/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: 0 0 0\n");
    folder_.Write("day/drive/oxts/data/0000000000.txt", Packet(0));
    folder_.Write("day/drive/oxts/data/0000000001.txt", Packet(2));
    folder_.Write("day/drive/oxts/timestamps.txt",
                  "2011-09-26 13:02:25.9\n2011-09-26 13:02:26.0\n");
    folder_.Write(
        "day/drive/tracklet_labels.xml",
        "<boost_serialization><tracklets><item><objectType>Car</objectType><h>2</h><w>2</w><l>4</l>"
        "<first_frame>1</first_frame><poses><item><tx>10</tx><ty>3</ty><tz>-2</tz><rz>0</rz></"
        "item></poses></item>"
        "</tracklets></boost_serialization>");
    request_ = Request(folder_.path() + "/day/drive");
  }

  TempFolder folder_;
  DatasetRequest request_;
};

TEST_F(RawDrive, StandsOnItsOwn) {
  const Dataset dataset = LoadDataset(request_);
  EXPECT_EQ(dataset.format, "kitti-raw");
  EXPECT_EQ(dataset.name, "drive");
  ASSERT_EQ(dataset.frames.size(), 2u);
  EXPECT_NEAR(dataset.frames[1].stamp, 0.1, 1e-9);
  EXPECT_LT((dataset.frames[1].T_odom_cam.translation() - Vec3(0, -2, 0)).norm(), 1e-9);
  ASSERT_EQ(dataset.frames[1].detections.size(), 1u);
  const Pose& car = dataset.frames[1].detections[0].T_cam_object;
  EXPECT_LT((car.translation() - Vec3(-3, 1, 10)).norm(), 1e-12);
  EXPECT_LT((car.so3() * Vec3(1, 0, 0) - Vec3(0, 0, 1)).norm(), 1e-12) << "faces away";
  EXPECT_EQ(dataset.camera->width, 1242);
  EXPECT_FALSE(dataset.groundtruth.has_value()) << "it is the odometry already";
  EXPECT_THAT(dataset.warnings, Contains(HasSubstr("the ground truth")));
  EXPECT_THAT(dataset.warnings, Contains(HasSubstr("hand-labelled tracklets")));
}

TEST_F(RawDrive, OdometryOfItsOwnFreesTheGroundTruth) {
  request_.odometry = folder_.Write("slam.txt", kPoses);
  const Dataset dataset = LoadDataset(request_);
  EXPECT_EQ(dataset.frames[1].T_odom_cam.translation(), Vec3(0, 0, 1));
  ASSERT_TRUE(dataset.groundtruth.has_value());
  EXPECT_LT((dataset.groundtruth->poses[1].translation() - Vec3(0, -2, 0)).norm(), 1e-9);
}

TEST_F(RawDrive, TrackletsNeedTheLidarsPlace) {
  std::filesystem::remove(folder_.path() + "/day/calib_velo_to_cam.txt");
  request_.odometry = folder_.Write("slam.txt", kPoses);
  ExpectError([&] { LoadDataset(request_); }, {"tracklet_labels.xml", "calib_velo_to_cam.txt"});
}

TEST_F(RawDrive, MayBeNamedAsASequence) {
  request_.path = folder_.path() + "/day";
  request_.sequence = "drive";
  EXPECT_EQ(LoadDataset(request_).name, "drive");
}

}  // namespace
}  // namespace sslcd
