// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/disparity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/median.h"
#include "stereo/stereo_scene.h"

namespace sslcd {
namespace {

TEST(MatchInside, FindsAWallAtAnyScale) {
  StereoScene scene;
  scene.Add(0, 9, 0, {30, 2, 12});  // its near side is 8 m away
  scene.Render();
  const double truth = 450 * 0.3 / 8;
  for (double scale : {0.5, 1., 2.}) {
    const DisparityPatch patch =
        MatchInside({scene.left, scene.right}, {300, 60, 420, 150}, 40, scale, std::min(scale, 1.));
    ASSERT_FALSE(patch.values.empty());
    EXPECT_NEAR(patch.x0, 300, 1.1);
    EXPECT_NEAR(patch.x0 + patch.step_x * patch.values.cols, 420, 2.1);
    int known = 0, close = 0;
    for (int y = 0; y < patch.values.rows; ++y) {
      for (int x = 0; x < patch.values.cols; ++x) {
        known += patch.values.at<float>(y, x) > 0;
        close += std::abs(patch.values.at<float>(y, x) - truth) < 0.35 * std::max(1., 1 / scale);
      }
    }
    EXPECT_GT(known, 0.6 * static_cast<double>(patch.values.total())) << scale;
    EXPECT_GT(close, 0.95 * known) << scale;
  }
}

TEST(MatchInside, DisparitiesAreNotPulledToWholePixels) {
  for (double share : {0.2, 0.35, 0.5, 0.65, 0.8}) {
    StereoScene scene;
    const double truth = 12 + share;
    scene.Add(0, 450 * 0.3 / truth + 1, 0, {30, 2, 12});
    scene.Render();
    const DisparityPatch patch =
        MatchInside({scene.left, scene.right}, {300, 60, 420, 150}, 40, 1, 1);
    std::vector<float> values;
    for (int y = 0; y < patch.values.rows; ++y) {
      for (int x = 0; x < patch.values.cols; ++x)
        if (patch.values.at<float>(y, x) > 0) values.push_back(patch.values.at<float>(y, x));
    }
    ASSERT_GT(values.size(), 1000u);
    EXPECT_NEAR(Median(values), truth, 0.04) << share;
  }
}

TEST(MatchInside, CountsFromWhatIsInfinitelyFar) {
  for (double at_infinity : {-2.3, 0.4, 2.8}) {
    StereoScene scene;
    scene.camera.disparity_at_infinity = at_infinity;
    scene.Add(0, 450 * 0.3 / 15.2 + 1, 0, {30, 2, 12});
    scene.Render();
    const DisparityPatch patch =
        MatchInside(GreyOf(scene.view(), scene.camera), {300, 60, 420, 150}, 20, 1, 1);
    std::vector<float> values;
    for (int y = 0; y < patch.values.rows; ++y) {
      for (int x = 0; x < patch.values.cols; ++x)
        if (patch.values.at<float>(y, x) > 0) values.push_back(patch.values.at<float>(y, x));
    }
    ASSERT_GT(values.size(), 1000u);
    EXPECT_NEAR(Median(values), 15.2, 0.05) << at_infinity;
  }
}

TEST(MatchInside, NothingIsKnownWithoutPixelsOrTexture) {
  StereoScene scene;
  scene.Render();
  for (const Box2d& box :
       {Box2d{-100, 10, -50, 60}, Box2d{700, 10, 800, 60}, Box2d{50, 50, 50, 60}, Box2d{}})
    EXPECT_TRUE(MatchInside({scene.left, scene.right}, box, 40, 1, 1).values.empty());
  const cv::Mat black(scene.left.size(), CV_8U, cv::Scalar(0));
  const DisparityPatch patch = MatchInside({black, black}, {200, 100, 300, 200}, 40, 1, 1);
  for (int y = 0; y < patch.values.rows; ++y) {
    for (int x = 0; x < patch.values.cols; ++x) EXPECT_FALSE(patch.values.at<float>(y, x) > 0);
  }
}

}  // namespace
}  // namespace sslcd
