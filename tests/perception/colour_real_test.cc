// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "sslcd/perception/colour.h"

namespace sslcd {
namespace {

/// Frames 0 and 10 of KITTI odometry 02, 10 m of driving apart, and hand-drawn boxes of what is in
/// both.
class RealImages : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("SSLCD_DATA_DIR");
    const std::string folder =
        std::string(data ? data : SSLCD_DEFAULT_DATA_DIR) + "/kitti-stereo-color/image_2/";
    first_ = cv::imread(folder + "000000.png", cv::IMREAD_COLOR);
    second_ = cv::imread(folder + "000010.png", cv::IMREAD_COLOR);
    if (first_.empty() || second_.empty()) GTEST_SKIP() << "skipped: no data in " << folder;
  }

  static std::vector<float> Colour(const cv::Mat& image, const Box2d& box) {
    const ImageView view{image.data, image.cols, image.rows, image.step[0], image.channels()};
    return ColourVector(view, box, {});
  }

  static double Cosine(const std::vector<float>& a, const std::vector<float>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
  }

  cv::Mat first_, second_;
};

TEST_F(RealImages, TheSameThingLooksTheSameTenMetresOn) {
  struct Thing {
    const char* name;
    Box2d first, second;
  };
  const Thing things[] = {{"blue car", {480, 180, 513, 205}, {264, 183, 401, 264}},
                          {"white board", {619, 136, 637, 160}, {634, 124, 656, 153}},
                          {"red bush", {330, 168, 394, 196}, {245, 166, 312, 205}}};
  for (const Thing& a : things) {
    for (const Thing& b : things) {
      const double cosine = Cosine(Colour(first_, a.first), Colour(second_, b.second));
      if (a.name == b.name) {
        EXPECT_GE(cosine, 0.85) << a.name;
      } else {
        EXPECT_LE(cosine, 0.75) << a.name << " / " << b.name;
      }
    }
  }
}

}  // namespace
}  // namespace sslcd
