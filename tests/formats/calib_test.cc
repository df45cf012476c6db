// SPDX-License-Identifier: BSD-3-Clause
#include "formats/calib.h"

#include "temp_folder.h"

namespace sslcd {
namespace {

const char kP2[] = "700 0 600 70 0 710 180 71 0 0 1 0.01";
const char kTurn[] = "0 -1 0 0 0 -1 1 0 0";  // lidar (x ahead, y left, z up) to camera
const char kVeloToCam[] = "0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3";

TEST(CalibReader, ReadsTheProjection) {
  const TempFolder folder;
  const Calibration calibration =
      ReadCalibration(folder.Write("calib.txt", std::string("P2: ") + kP2 + "\n"));
  ASSERT_TRUE(calibration.left.has_value());
  const Camera& camera = *calibration.left;
  EXPECT_EQ(camera.fx, 700);
  EXPECT_EQ(camera.fy, 710);
  EXPECT_EQ(camera.cx, 600);
  EXPECT_EQ(camera.cy, 180);
  EXPECT_EQ(camera.width, 0) << "unknown";
  // K (X + offset) must be P [X; 1].
  const Vec3 X(1, 2, 10), in_camera = X + camera.offset;
  const Vec3 expected(700 * 1 + 600 * 10 + 70., 710 * 2 + 180 * 10 + 71., 10.01);
  const Vec3 pixel(camera.fx * in_camera.x() + camera.cx * in_camera.z(),
                   camera.fy * in_camera.y() + camera.cy * in_camera.z(), in_camera.z());
  EXPECT_LT((pixel - expected).norm(), 1e-9);
  EXPECT_FALSE(calibration.right.has_value());
  EXPECT_FALSE(calibration.HasImu());
}

TEST(CalibReader, KeysMayComeWithoutColon) {
  const TempFolder folder;
  const Calibration calibration = ReadCalibration(
      folder.Write("calib.txt", std::string("P2: ") + kP2 + "\nP3: " + kP2 +
                                    "\nR_rect 1 0 0 0 1 0 0 0 1\nTr_velo_cam " + kVeloToCam +
                                    "\nTr_imu_velo 1 0 0 5 0 1 0 6 0 0 1 7\n"));
  ASSERT_TRUE(calibration.HasImu());
  EXPECT_TRUE(calibration.right.has_value());
  EXPECT_LT((*calibration.T_cam_velo * Vec3(10, 0, 0) - Vec3(.1, .2, 10.3)).norm(), 1e-12);
  EXPECT_LT((calibration.T_velo_imu->translation() - Vec3(5, 6, 7)).norm(), 1e-12);
}

TEST(CalibReader, ReadsGreyCamerasAndRowsWithoutKeys) {
  const TempFolder folder;
  const std::string left = "700 0 600 0 0 710 180 0 0 0 1 0",
                    right = "700 0 600 -350 0 710 180 0 0 0 1 0";
  for (const std::string& text :
       {left + "\n" + right, "P0: " + left + "\nP1: " + right + "\nP2: " + right + "\n1 2",
        "P2: " + left + "\nP3: " + right}) {
    const Calibration calibration =
        ReadCalibration(folder.Write("calib.txt", text), CameraPair::kGrey);
    ASSERT_TRUE(calibration.left && calibration.right);
    EXPECT_EQ(calibration.left->fy, 710);
    EXPECT_NEAR(MakeStereoCamera(*calibration.left, *calibration.right).baseline_m, 0.5, 1e-12);
  }
  ExpectError([&] { ReadCalibration(folder.Write("calib.txt", "P3: " + left), CameraPair::kGrey); },
              {"calib.txt:1", "no P0", "found: P3"});
}

TEST(CalibReader, ReadsARawDrive) {
  const TempFolder folder;
  folder.Write("calib_cam_to_cam.txt",
               std::string("calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.95e-02\nP_rect_02: ") +
                   kP2 + "\nS_rect_02: 1.242e+03 3.75e+02\nR_rect_00: 1 0 0 0 0 -1 0 1 0\n");
  folder.Write("calib_velo_to_cam.txt",
               std::string("calib_time: 15-Mar-2012\nR: ") + kTurn + "\nT: 0.1 0.2 0.3\n");
  const Calibration calibration = ReadRawCalibration(folder.path());
  EXPECT_EQ(calibration.left->width, 1242);
  EXPECT_EQ(calibration.left->height, 375);
  ASSERT_TRUE(calibration.T_cam_velo.has_value());
  // (.1, .2, 10.3), turned by R_rect_00.
  EXPECT_LT((*calibration.T_cam_velo * Vec3(10, 0, 0) - Vec3(.1, -10.3, .2)).norm(), 1e-12);
  EXPECT_FALSE(calibration.T_velo_imu.has_value());
}

TEST(CalibReader, RefusesBadEntries) {
  const TempFolder folder;
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    ExpectError([&] { ReadCalibration(folder.Write("calib.txt", text)); }, parts);
  };
  const std::string good = std::string("P2: ") + kP2 + "\n";
  refuse("", {"calib.txt:1: no P2", "found: nothing"});
  refuse("P0: 1 2 3\nP1: 1 2 3\n", {"calib.txt:2: no P2", "found: P0, P1"});
  refuse("\nP2: 1 2 3\n", {"calib.txt:2: P2: found 3 numbers, expected 12"});
  refuse("P2: 700 0 600 70 0 710 180 71 0 0 1 x\n",
         {"calib.txt:1: P2: expected a number, found 'x'"});
  refuse("P2: 0 0 600 70 0 710 180 71 0 0 1 0\n", {"calib.txt:1", "no projection matrix"});
  refuse("P2: nan 0 600 70 0 710 180 71 0 0 1 0\n", {"calib.txt:1", "no projection matrix"});
  refuse(good + "Tr: 2 0 0 0 0 1 0 0 0 0 1 0\n", {"calib.txt:2: not a rotation matrix"});
  refuse(good + ", 1 2\n", {"calib.txt:2: a row 'key: numbers' without a key"});
  for (const char* size : {"-5 10", "10 1e300", "10 nan"})
    refuse(good + "S_rect_02: " + size + "\n", {"calib.txt:2: S_rect_02: expected the width"});
  ExpectError([&] { ReadRawCalibration(folder.path()); }, {"calib_cam_to_cam.txt", "No such file"});
}

}  // namespace
}  // namespace sslcd
