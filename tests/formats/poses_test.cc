// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/formats/poses.h"

#include <cmath>

#include "temp_folder.h"

namespace sslcd {
namespace {

constexpr double kQuarter = M_PI / 2;

/// A quarter turn about y (z -> x), at (1, 2, 3), in each format.
const char kTum[] = "10.5 1 2 3 0 0.70710678 0 0.70710678\n";
const char kKitti[] = "0 0 1 1 0 1 0 2 -1 0 0 3\n";
const char kVins[] = "10500000000,1,2,3,0.70710678,0,0.70710678,0,9,9,9,\n";

void ExpectQuarterTurn(const Pose& pose) {
  const Pose expected(lie::SO3<double>::RotY(kQuarter), Vec3(1, 2, 3));
  const double error = (expected.inverse() * pose).Log().norm();
  EXPECT_FALSE(!(error < 1e-7)) << error;
}

TEST(PoseReader, TellsTheFormatsApart) {
  const TempFolder folder;
  const PoseFile tum = ReadPoseFile(folder.Write("tum.txt", std::string("# t x y z q\n") + kTum));
  const PoseFile kitti = ReadPoseFile(folder.Write("kitti.txt", std::string(kKitti) + kKitti));
  const PoseFile vins = ReadPoseFile(folder.Write("vins.csv", kVins));
  EXPECT_EQ(tum.format, PoseFormat::kTum);
  EXPECT_EQ(kitti.format, PoseFormat::kKitti);
  EXPECT_EQ(vins.format, PoseFormat::kVinsCsv);
  for (const PoseFile* file : {&tum, &kitti, &vins})
    ExpectQuarterTurn(file->trajectory.poses.at(0));
  EXPECT_THAT(tum.trajectory.stamps, testing::ElementsAre(10.5));
  EXPECT_THAT(kitti.trajectory.stamps, testing::ElementsAre(0, 1));
  EXPECT_THAT(vins.trajectory.stamps, testing::ElementsAre(10.5));
}

TEST(PoseReader, EmptyFileIsAnEmptyTrajectory) {
  const TempFolder folder;
  EXPECT_EQ(ReadTrajectory(folder.Write("a.txt", "\n# nothing\n")).size(), 0u);
}

TEST(PoseReader, MendsSmallErrorsAndRefusesLargeOnes) {
  const TempFolder folder;
  ExpectQuarterTurn(ReadTrajectory(folder.Write("a.txt", "0 1 2 3 0 0.7072 0 0.7072")).poses.at(0));
  const Pose mended =
      ReadTrajectory(folder.Write("b.txt", "1.001 0 0 0 0 1 0 0 0 0 1 0")).poses.at(0);
  const Eigen::Matrix3d R = mended.so3().matrix();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-12);

  const auto refuse = [&](const char* row, const char* part) {
    ExpectError([&] { ReadTrajectory(folder.Write("c.txt", std::string("\n") + row)); },
                {"c.txt:2: ", part});
  };
  refuse("0 1 2 3 0 0.8 0 0.7", "unit length");
  refuse("0 1 2 3 0 0 0 0", "unit length");
  refuse("0 1 nan 3 0 0 0 1", "not finite");
  refuse("0 1 2 3 0 0 0 nan", "unit length");
  refuse("nan 1 2 3 0 0 0 1", "stamp is not finite");
  refuse("1.1 0 0 0 0 1 0 0 0 0 1 0", "not a rigid transform");
  refuse("-1 0 0 0 0 1 0 0 0 0 1 0", "not a rigid transform");
  refuse("1 0 0 inf 0 1 0 0 0 0 1 0", "not a rigid transform");
  refuse("0 0 0 0 0 0 0 0 0 0 0 0", "not a rigid transform");
}

TEST(PoseReader, RefusesMalformedRows) {
  const TempFolder folder;
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    ExpectError([&] { ReadTrajectory(folder.Write("a.txt", text)); }, parts);
  };
  refuse("1 2 3\n", {"a.txt:1: not a pose row", "3 columns", "TUM"});
  refuse("1,2,3\n", {"a.txt:1: not a pose row"});
  refuse(std::string(kKitti) + "0 0 1 1 0 1 0 2 -1\n", {"a.txt:2: found 9 columns, expected 12"});
  refuse(std::string(kKitti) + kTum, {"a.txt:2: found 8 columns, expected 12"});
  refuse("0 1 2 3 0 0 0 1x\n", {"a.txt:1: column 8", "'1x'"});
  refuse("0 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n", {"a.txt:2: stamp 0", "must increase"});
  refuse("1 0 0 0 0 0 0 1\n0.5 0 0 0 0 0 0 1\n", {"a.txt:2: stamp 0.5", "must increase"});
  ExpectError([&] { ReadTrajectory(folder.Write("b.txt", kTum), PoseFormat::kKitti); },
              {"b.txt:1", "expected 12"});
  ExpectError([&] { ReadTrajectory(folder.path() + "/none.txt"); }, {"none.txt", "No such file"});
}

Trajectory Path() {
  Trajectory trajectory;
  for (int i = 0; i < 5; ++i) {
    Vec6 xi;
    xi << i, -0.5 * i, 1e-12, 0.3 * i, 0.1, -0.7 * i;
    trajectory.stamps.push_back(0.1 * i);
    trajectory.poses.push_back(Pose::Exp(xi));
  }
  return trajectory;
}

TEST(PoseText, TrajectoriesReadBack) {
  const TempFolder folder;
  const Trajectory path = Path();
  folder.Write("tum.txt", TumText(path));
  folder.Write("kitti.txt", KittiText(path));
  for (const char* name : {"tum.txt", "kitti.txt"}) {
    const Trajectory read = ReadTrajectory(folder.In(name));
    ASSERT_EQ(read.size(), path.size());
    for (std::size_t i = 0; i < path.size(); ++i)
      EXPECT_LT((read.poses[i].inverse() * path.poses[i]).Log().norm(), 1e-7);
  }
  EXPECT_EQ(TumText(path).find(" \n"), std::string::npos)
      << "evo refuses a blank at the end of a row";
  EXPECT_EQ(TumText(path).find("-0.000000000"), std::string::npos);
}

TEST(PoseReader, ATumRowMayReportTheUncertaintyOfItsStep) {
  const TempFolder folder;
  const PoseFile file = ReadPoseFile(
      folder.Write("a.txt",
                   "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1 0.2 3e-2\r\n2 1 0 0 0 0 0 1 lost\n"
                   "3 2 0 0 0 0 0 1\n4 3 0 0 0 0 0 1 0 0\n"));
  EXPECT_EQ(file.format, PoseFormat::kTum);
  ASSERT_EQ(file.trajectory.size(), 5u);
  ASSERT_EQ(file.steps.size(), 5u);
  EXPECT_FALSE(file.steps[0].has_value());
  ASSERT_TRUE(file.steps[1].has_value());
  EXPECT_FALSE(file.steps[1]->lost);
  EXPECT_EQ(file.steps[1]->translation_m, 0.2);
  EXPECT_EQ(file.steps[1]->rotation_rad, 0.03);
  ASSERT_TRUE(file.steps[2].has_value());
  EXPECT_TRUE(file.steps[2]->lost);
  EXPECT_FALSE(file.steps[3].has_value());
  ASSERT_TRUE(file.steps[4].has_value());
  EXPECT_EQ(file.steps[4]->translation_m, 0);
  for (const char* first : {"0 0 0 0 0 0 0 1 0.1 0.1\n", "0 0 0 0 0 0 0 1 lost\n"})
    EXPECT_EQ(ReadPoseFile(folder.Write("b.txt", first)).format, PoseFormat::kTum);
}

TEST(PoseReader, RefusesMalformedUncertainties) {
  const TempFolder folder;
  const std::string pose = "1 0 0 0 0 0 0 1";
  const auto refuse = [&](const std::string& row, const std::vector<std::string>& parts) {
    ExpectError([&] { ReadTrajectory(folder.Write("a.txt", "0 0 0 0 0 0 0 1\n" + row + "\n")); },
                parts);
  };
  refuse(pose + " 0.1", {"a.txt:2: column 9", "'0.1'", "'lost'", "[rad]"});
  refuse(pose + " LOST", {"a.txt:2: column 9", "'LOST'"});
  refuse(pose + " lost lost", {"a.txt:2: column 9", "'lost'"});
  refuse(pose + " 0.1 x", {"a.txt:2: column 10", "'x'"});
  for (const char* bad : {" -0.1 0.1", " 0.1 -0.1", " nan 0.1", " 0.1 inf"})
    refuse(pose + bad, {"a.txt:2: columns 9 and 10", "negative or not finite", "'lost'"});
  refuse(pose + " 0.1 0.1 0.1",
         {"a.txt:2: found 11 columns, expected 8", "two standard deviations"});
  refuse("1 0 0 0 0 0 0", {"a.txt:2: found 7 columns, expected 8"});
}

}  // namespace
}  // namespace sslcd
