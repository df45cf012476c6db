// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/foreign.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "formats/atomic_file.h"
#include "sslcd/core/error.h"
#include "sslcd/formats/poses.h"
#include "temp_folder.h"

namespace sslcd::benchmark {
namespace {

class Foreign : public testing::Test {
 protected:
  Foreign() {
    for (int i = 0; i < 100; ++i) {
      truth_.stamps.push_back(10 + 0.1 * i);
      truth_.poses.push_back(Pose::Trans(0.3 * i, 0, std::sin(0.1 * i)));
    }
  }
  void ExpectRefused(const std::string& text, const std::string& message) {
    WriteFileAtomically(file_, text);
    try {
      ForeignAte(file_, truth_);
      FAIL() << message;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
  TempFolder temp_;
  const std::string file_ = temp_.path() + "/foreign.txt";
  Trajectory truth_;
};

TEST_F(Foreign, ScaleAndFrameDoNotCount) {
  Trajectory other = truth_;
  for (Pose& pose : other.poses) pose = Pose::RotZ(1.) * Pose(pose.so3(), 1.1 * pose.translation());
  WriteFileAtomically(file_, TumText(other));
  EXPECT_NEAR(ForeignAte(file_, truth_).rmse, 0, 1e-6);
  other.poses[50].translation() += Vec3(0, 1, 0);
  WriteFileAtomically(file_, TumText(other));
  EXPECT_GT(ForeignAte(file_, truth_).max, 0.5);
}

TEST_F(Foreign, AFewMissingPosesAreFine) {
  Trajectory other = truth_;
  other.stamps.resize(93);
  other.poses.resize(93);
  WriteFileAtomically(file_, TumText(other));
  EXPECT_EQ(ForeignAte(file_, truth_).count, 93);
}

TEST_F(Foreign, Refused) {
  Trajectory other = truth_;
  other.stamps.resize(50);
  other.poses.resize(50);
  ExpectRefused(TumText(other), "has poses for 50 of 100 frames");
  ExpectRefused(KittiText(truth_), "no stamps");
  for (double& stamp : other.stamps) stamp += 1e6;
  ExpectRefused(TumText(other), "same clock");
  ExpectRefused("", "foreign.txt");
  ExpectRefused("1 2 3\n", "foreign.txt:1");
  std::filesystem::remove(file_);
  EXPECT_THROW(ForeignAte(file_, truth_), Error);
}

}  // namespace
}  // namespace sslcd::benchmark
