// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/oxts.h"

#include <cmath>

#include "temp_folder.h"

namespace sslcd {
namespace {

/// lat lon alt roll pitch yaw and 24 zeros.
std::string Packet(double lat, double lon, double alt, double yaw) {
  char text[200];
  std::snprintf(text, sizeof(text), "%.12f %.12f %.6f 0 0 %.12f", lat, lon, alt, yaw);
  std::string packet = text;
  for (int i = 0; i < 24; ++i) packet += " 0";
  return packet + "\n";
}

constexpr double kMetre = 180 / (M_PI * 6378137.);  // of latitude, in degrees

TEST(Oxts, ProjectsToMetres) {
  const TempFolder folder;
  // 100 m to the east, then 100 m to the north; the first pose faces north (yaw counts from east).
  const double lat = 49, lon = 8, east = 100 * kMetre / std::cos(lat * M_PI / 180);
  const std::string file = folder.Write("0000.txt", Packet(lat, lon, 110, M_PI / 2) +
                                                        Packet(lat, lon + east, 111, M_PI / 2) +
                                                        Packet(lat + 100 * kMetre, lon, 110, M_PI));
  const std::vector<Pose> poses = ReadOxts(file);
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_LT(poses[0].Log().norm(), 1e-9);
  EXPECT_LT((poses[1].translation() - Vec3(0, -100, 1)).norm(), 1e-3) << "east is to the right";
  EXPECT_LT((poses[2].translation() - Vec3(100, 0, 0)).norm(), 2e-2) << "north is ahead";
  EXPECT_LT((poses[2].so3() * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 1e-9);
}

TEST(Oxts, BecomesPosesOfTheCamera) {
  const TempFolder folder;
  Calibration calibration;
  const std::string file =
      folder.Write("0.txt", Packet(49, 8, 0, M_PI / 2) + Packet(49 + 10 * kMetre, 8, 0, M_PI / 2));
  ExpectError([&] { ReadOxtsCamera(file, calibration); },
              {"lacks the transform from IMU to camera"});
  Eigen::Matrix3d R;  // IMU and lidar: x ahead, y left, z up
  R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  calibration.T_cam_velo = Pose(lie::SO3<double>::FromMatrix(R), Vec3(0, 0, 0));
  calibration.T_velo_imu = Pose();
  EXPECT_LT((ReadOxtsCamera(file, calibration).at(1).translation() - Vec3(0, 0, 10)).norm(), 1e-3);
}

TEST(Oxts, ReadsAFolderOfPackets) {
  const TempFolder folder;
  folder.Write("data/0000000000.txt", Packet(49, 8, 0, 0));
  folder.Write("data/0000000001.txt", Packet(49, 8, 1, 0));
  EXPECT_EQ(ReadOxts(folder.path() + "/data").size(), 2u);
  folder.Write("data/0000000003.txt", Packet(49, 8, 1, 0));
  ExpectError([&] { ReadOxts(folder.path() + "/data"); }, {"oxts packet 2 is missing"});
  folder.Write("data/0000000002.txt", "");
  ExpectError([&] { ReadOxts(folder.path() + "/data"); },
              {"0000000002.txt", "exactly one oxts packet"});
}

TEST(Oxts, RefusesMalformedPackets) {
  const TempFolder folder;
  ExpectError([&] { ReadOxts(folder.Write("a.txt", "1 2 3\n")); },
              {"a.txt:1: found 3 columns", "30"});
  ExpectError([&] { ReadOxts(folder.Write("a.txt", Packet(NAN, 8, 0, 0))); },
              {"a.txt:1", "not finite"});
  ExpectError([&] { ReadOxts(folder.Write("a.txt", Packet(90, 8, 0, 0))); },
              {"a.txt:1", "latitude"});
  EXPECT_TRUE(ReadOxts(folder.Write("a.txt", "")).empty());
}

TEST(Oxts, StampsCountFromTheFirst) {
  const TempFolder folder;
  const auto read = [&](const std::string& text) {
    return ReadTimestamps(folder.Write("timestamps.txt", text));
  };
  const std::vector<double> stamps = read(
      "2012-02-28 23:59:59.500000000\n2012-02-29 00:00:00.250000000\n2012-03-01 00:00:00.25\n");
  ASSERT_EQ(stamps.size(), 3u);
  EXPECT_EQ(stamps[0], 0);
  EXPECT_NEAR(stamps[1], 0.75, 1e-9);
  EXPECT_NEAR(stamps[2], 86400.75, 1e-9);
  ExpectError([&] { read("2011-09-26 13:02:25.9\n2011-09-26 13:02:25.9\n"); },
              {"timestamps.txt:2", "does not come after"});
  ExpectError([&] { read("2011-09-26\n"); }, {"timestamps.txt:1", "date and time"});
  ExpectError([&] { read("2011-09-26 13:02\n"); }, {"timestamps.txt:1", "expected a stamp like"});
  for (const char* stamp : {"2011-09-2x 13:02:25", "1e99-09-26 13:02:25", "2011-99-99 13:02:25",
                            "2011-09-26 13:02:nan", "2011-09-26 13:02:61"})
    ExpectError([&] { read(stamp + std::string("\n")); },
                {"timestamps.txt:1", "expected a stamp like"});
}

}  // namespace
}  // namespace sslcd
