// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/groundtruth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sslcd {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Frame> FramesEveryTenth(int count) {
  std::vector<Frame> frames(count);
  for (int i = 0; i < count; ++i) frames[i].stamp = 0.1 * i;
  return frames;
}

PoseFile Truth(std::vector<double> stamps, PoseFormat format = PoseFormat::kTum) {
  PoseFile file;
  file.format = format;
  file.trajectory.poses.resize(stamps.size());
  file.trajectory.stamps = std::move(stamps);
  return file;
}

class GroundtruthOfFramesTest : public testing::Test {
 protected:
  std::optional<Trajectory> Of(const PoseFile& file) {
    return GroundtruthOfFrames(file, "truth.txt", FramesEveryTenth(3), 3, warnings_);
  }
  std::vector<std::string> warnings_;
};

TEST_F(GroundtruthOfFramesTest, KeepsStampsOfTheSameClockAtAnyRate) {
  const std::vector<double> stamps{0.095, 0.145, 0.195, 0.245};
  EXPECT_EQ(Of(Truth(stamps))->stamps, stamps);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(GroundtruthOfFramesTest, TakesOnePosePerFrameWithAnotherClockByRow) {
  EXPECT_EQ(Of(Truth({1e9, 1e9 + 0.1, 1e9 + 0.2}))->stamps[2], FramesEveryTenth(3)[2].stamp);
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("row i is taken as frame i")));
}

TEST_F(GroundtruthOfFramesTest, RefusesAFileWithoutPoses) {
  EXPECT_FALSE(Of(Truth({})).has_value());
  EXPECT_FALSE(Of(Truth({}, PoseFormat::kKitti)).has_value());
  EXPECT_THAT(warnings_, testing::Each(HasSubstr("truth.txt: has no poses")));
}

TEST_F(GroundtruthOfFramesTest, RefusesAnotherClockAndNumber) {
  EXPECT_FALSE(Of(Truth({0.111, 0.15, 0.189, 0.211})).has_value()) << "11 ms are no frame's time";
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("truth.txt: no stamp (0.111000 to 0.211000 s)")));
}

TEST_F(GroundtruthOfFramesTest, PairsRowsWithoutStampsByNumber) {
  const std::optional<Trajectory> more = Of(Truth({0, 1, 2, 3}, PoseFormat::kKitti));
  EXPECT_THAT(more->stamps, ElementsAre(0, 0.1, 0.2));
  EXPECT_EQ(more->poses.size(), 3u);
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("4 ground-truth poses for 3 frames")));
}

}  // namespace
}  // namespace sslcd
