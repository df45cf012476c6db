// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/stereo_files.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "sslcd/core/log.h"
#include "stereo/stereo_scene.h"

namespace sslcd {
namespace {

Image Copied(const cv::Mat& mat) {
  Image image{{}, mat.cols, mat.rows, mat.channels()};
  for (int row = 0; row < mat.rows; ++row)
    image.pixels.insert(image.pixels.end(), mat.ptr(row), mat.ptr(row) + mat.cols * mat.elemSize());
  return image;
}

/// Two places of one car park, their images as files "a/left", ..., and what was logged.
class GroundAligner : public testing::Test {
 protected:
  GroundAligner() {
    b_.T_scene_cam = T_a_b_;
    a_.Render();
    b_.Render();
    files_.paths = {{"a/left", "a/right"}, {"b/left", "b/right"}, {"broken", "broken"}, {"", ""}};
    files_.load = [this](const std::string& path) -> Image {
      if (path == "broken") return {};
      const StereoScene& scene = path[0] == 'a' ? a_ : b_;
      return Copied(path.substr(2) == "left" ? scene.left : scene.right);
    };
    before_ = SetLogSink([this](LogLevel, const std::string& line) { log_.push_back(line); });
  }
  ~GroundAligner() override { SetLogSink(before_); }

  std::vector<std::optional<RelativePose>> Align(const std::vector<ViewPair>& pairs,
                                                 GroundAlignerOptions options = {}) {
    return MakeGroundAligner(files_, a_.camera, {}, options)(pairs);
  }

  StereoScene a_, b_;
  Pose T_a_b_ = Pose::Trans(0.3, 0, 7) * Pose::RotY(M_PI) * Pose::Trans(0.2, 0, -7);
  StereoFiles files_;
  std::vector<std::string> log_;
  LogSink before_;
};

TEST_F(GroundAligner, AnswersEachPairInItsPlace) {
  const ViewPair good{0, 1, T_a_b_}, broken{0, 2, T_a_b_}, missing{3, 1, T_a_b_};
  for (const int threads : {1, 3}) {
    log_.clear();
    int done = 0;
    const auto answers =
        Align({broken, good, missing}, {false, threads, [&](int, int) { ++done; }});
    ASSERT_EQ(answers.size(), 3u);
    EXPECT_FALSE(answers[0]);
    ASSERT_TRUE(answers[1]);
    EXPECT_LT((T_a_b_.inverse() * answers[1]->T_a_b).Log().norm(), 0.02);
    EXPECT_FALSE(answers[2]) << "has no images";
    EXPECT_EQ(done, 3);
    ASSERT_EQ(log_.size(), 1u) << "said once";
    EXPECT_NE(log_[0].find("broken: not aligned"), std::string::npos) << log_[0];
  }
}

TEST_F(GroundAligner, ReadsNothingWhenStopped) {
  files_.stop = [] { return true; };
  files_.load = [](const std::string&) -> Image { throw std::logic_error("read"); };
  EXPECT_FALSE(Align({{0, 1, T_a_b_}}, {true, 1, {}}).at(0));
}

TEST_F(GroundAligner, ImagesThatDoNotFitTheCameraAreSaidNotThrown) {
  a_.camera.left.width = 100;
  a_.camera.left.height = 100;
  EXPECT_FALSE(Align({{0, 1, T_a_b_}}).at(0));
  EXPECT_EQ(log_.size(), 1u);
}

}  // namespace
}  // namespace sslcd
