// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "../support/temp_folder.h"
#include "detection_folder.h"
#include "rig.h"
#include "vins_config.h"

namespace sslcd::vins {
namespace {

const char kCamera[] =
    "%YAML:1.0\n---\nmodel_type: PINHOLE\ncamera_name: camera\nimage_width: 1241\n"
    "image_height: 376\ndistortion_parameters:\n   k1: 0\n   k2: 0\n   p1: 0\n   p2: 0\n"
    "projection_parameters:\n   fx: 7.2e+02\n   fy: 7.1e+02\n   cx: 607\n   cy: 185\n";

std::string Config(const std::string& imu, const std::string& matrix) {
  return "%YAML:1.0\n\n#common parameters\n" + imu +
         "cam0_calib: \"cam0.yaml\"\nsslcd_detections: \"../drive\"\n"
         "body_T_cam0: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [" +
         matrix + "]\n";
}
const char kForward[] = "0, 0, 1, 0.5,  -1, 0, 0, 0.1,  0, -1, 0, 0.2,  0, 0, 0, 1";
const char kIdentity[] = "1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1";

TEST(VinsConfig, HoldsCameraExtrinsicsAndImu) {
  const TempFolder folder;
  folder.Write("cam0.yaml", kCamera);
  const std::string path = folder.Write("vins.yaml", Config("imu: 1\n", kForward));
  const VinsConfig config = ReadVinsConfig(path);
  EXPECT_TRUE(config.rig.imu);
  EXPECT_EQ(config.rig.T_body_cam.translation(), Vec3(0.5, 0.1, 0.2));
  EXPECT_LT((config.rig.T_body_cam.so3() * Vec3(0, 0, 1) - Vec3(1, 0, 0)).norm(), 1e-12);
  ASSERT_TRUE(config.rig.camera);
  EXPECT_EQ(config.rig.camera->fx, 720);
  EXPECT_EQ(config.rig.camera->fy, 710);
  EXPECT_EQ(config.rig.camera->cx, 607);
  EXPECT_EQ(config.rig.camera->cy, 185);
  EXPECT_EQ(config.rig.camera->width, 1241);
  EXPECT_EQ(config.detections, folder.In("../drive"));
  EXPECT_TRUE(config.notes.empty());
}

TEST(VinsConfig, ACameraWithDistortionIsLeftOut) {
  const TempFolder folder;
  std::string camera = kCamera;
  folder.Write("cam0.yaml", camera.replace(camera.find("p1: 0"), 5, "p1: 1"));
  const std::string path = folder.Write("vins.yaml", Config("imu: 0\n", kIdentity));
  EXPECT_FALSE(ReadVinsConfig(path).rig.camera);
  EXPECT_EQ(ReadVinsConfig(path).notes.size(), 1u);
  folder.Write("cam0.yaml", "%YAML:1.0\n---\nmodel_type: MEI\n");
  EXPECT_FALSE(ReadVinsConfig(path).rig.camera);
}

TEST(VinsConfig, BadFilesAreErrors) {
  const TempFolder folder;
  folder.Write("cam0.yaml", kCamera);
  ExpectError([&] { ReadVinsConfig(folder.In("none.yaml")); }, {"none.yaml"});
  ExpectError([&] { ReadVinsConfig(folder.Write("a.yaml", Config("", kIdentity))); }, {"'imu'"});
  ExpectError([&] { ReadVinsConfig(folder.Write("b.yaml", "%YAML:1.0\nimu: 1\n")); },
              {"body_T_cam0"});
  const std::string twice = "2, 0, 0, 0,  0, 2, 0, 0,  0, 0, 2, 0,  0, 0, 0, 1";
  ExpectError([&] { ReadVinsConfig(folder.Write("c.yaml", Config("imu: 1\n", twice))); },
              {"no rigid transform"});
}

TEST(Rig, UpIsZWithAnImuAndTheCamerasMinusYWithout) {
  Rig rig;
  EXPECT_EQ(UpAxis(rig), Vec3(0, -1, 0));
  EXPECT_TRUE(MapperOptions(rig).level.enabled);
  rig.T_body_cam = Pose(lie::SO3<double>::RotZ(M_PI / 2), Vec3::Zero());
  EXPECT_LT((UpAxis(rig) - Vec3(1, 0, 0)).norm(), 1e-12) << "the camera is mounted on its side";
  rig.imu = true;
  EXPECT_EQ(UpAxis(rig), Vec3(0, 0, 1));
  EXPECT_FALSE(MapperOptions(rig).level.enabled);
  EXPECT_EQ(ContextOf(rig, {}).gravity.up, Vec3(0, 0, 1));
}

TEST(Rig, AFrameHasTheCamerasPoseAndVinssIndex) {
  Keyframe keyframe;
  keyframe.index = 12;
  keyframe.T_odom_body = Pose(lie::SO3<double>::RotZ(M_PI / 2), {10, 0, 0});
  keyframe.T_body_cam = Pose::Trans(1, 0, 0);
  const Frame frame = MakeFrame(keyframe, 3.5, std::vector<Detection>(2));
  EXPECT_EQ(frame.index, 12);
  EXPECT_EQ(frame.stamp, 3.5);
  EXPECT_EQ(frame.detections.size(), 2u);
  EXPECT_LT((frame.T_odom_cam.translation() - Vec3(10, 1, 0)).norm(), 1e-12);
}

TEST(DetectionFolder, GivesDetectionsByStamp) {
  const TempFolder folder;
  folder.Write("times.txt", "1403636579.7635\n1403636579.8135\n1403636579.8635\n");
  folder.Write("detections.txt",
               "0 -1 Car -1 -1 -10 -1 -1 -1 -1 1.5 1.7 4.2 1 1.6 9 0 0.9\n"
               "2 -1 Car -1 -1 -10 -1 -1 -1 -1 1.5 1.7 4.2 2 1.6 9 0 0.9\n"
               "2 -1 Tree -1 -1 -10 -1 -1 -1 -1 3 0.5 0.5 3 1.6 9 0 0.9\n");
  folder.Write("sequence.yaml", "labels: {Tree: {symmetry: full}}\n");
  const DetectionFolder detections(folder.path());
  EXPECT_EQ(detections.At(1403636579.7635).size(), 1u);
  EXPECT_TRUE(detections.At(1403636579.8135).empty());
  EXPECT_TRUE(detections.Has(1403636579.8135));
  EXPECT_EQ(detections.At(1403636579.8635 + 0.004).size(), 2u);
  EXPECT_EQ(detections.At(1403636579.8635 - 0.004).size(), 2u);
  EXPECT_FALSE(detections.Has(1403636579.8635 + 0.006));
  EXPECT_FALSE(detections.Has(0));
  EXPECT_EQ(detections.labels()["Tree"].symmetry, Symmetry::kFull);
}

TEST(DetectionFolder, IsAnErrorWithoutStamps) {
  const TempFolder folder;
  folder.Write("detections.txt", "");
  EXPECT_THROW(DetectionFolder{folder.path()}, Error);
  EXPECT_THROW(DetectionFolder{folder.In("none")}, Error);
}

}  // namespace
}  // namespace sslcd::vins
