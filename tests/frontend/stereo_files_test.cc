// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/stereo_files.h"

#include <gtest/gtest.h>

#include "sslcd/ground/ground_alignment.h"

namespace sslcd {
namespace {

/// No texture: nothing can be measured, and files are counted.
StereoFiles GreyFiles(int& loaded, std::function<bool()> stop = {}) {
  std::vector<Frame> frames(40);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].image_left = "left";
    frames[i].image_right = "right";
  }
  const auto load = [&loaded](const std::string&) {
    ++loaded;
    return Image{std::vector<unsigned char>(320 * 240, 128), 320, 240, 1};
  };
  return StereoFilesOf(frames, load, std::move(stop));
}

const StereoCamera kCamera{{200, 200, 160, 60, {}, 0, 0}, 0.5, 0.3};

TEST(StereoFiles, HaveTheFramesPaths) {
  std::vector<Frame> frames(2);
  frames[1].image_left = "l1";
  StereoFiles files = StereoFilesOf(frames, {});
  EXPECT_EQ(files.paths[1].first, "l1");
  EXPECT_FALSE(files.HasPairs()) << "the right image is missing";
  EXPECT_FALSE(files.stopped()) << "nobody can";
  frames[1].image_right = "r1";
  EXPECT_TRUE(StereoFilesOf(frames, {}).HasPairs());
}

TEST(CheckRigOfFiles, ImagesThatTellNothingLeaveTheCamera) {
  int loaded = 0;
  const RigCheck check = CheckRig(GreyFiles(loaded), kCamera, {});
  EXPECT_FALSE(check.row_error);
  EXPECT_EQ(check.disparity_at_infinity, 0.3);
  EXPECT_GT(loaded, 0);
}

TEST(CheckRigOfFiles, ReadsNothingWhenStopped) {
  int loaded = 0;
  CheckRig(GreyFiles(loaded, [] { return true; }), kCamera, {});
  EXPECT_EQ(loaded, 0);
}

TEST(AlignmentRangeOfFiles, IsThatOfTheFirstImageThatCanBeRead) {
  StereoFiles files;
  files.paths = {{"", "r"}, {"broken", ""}, {"good", ""}, {"never", ""}};
  files.load = [](const std::string& path) {
    EXPECT_NE(path, "never");
    return path == "good" ? Image{std::vector<unsigned char>(320 * 240), 320, 240, 1} : Image();
  };
  const auto range = AlignmentRange(files, kCamera.left, 1.5);
  ASSERT_TRUE(range);
  EXPECT_EQ(*range, AlignmentRange(kCamera.left, 240, 1.5));
  files.paths.resize(2);
  EXPECT_FALSE(AlignmentRange(files, kCamera.left, 1.5));
}

}  // namespace
}  // namespace sslcd
