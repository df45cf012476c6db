// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/stereo/ground_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sslcd/core/error.h"
#include "stereo_scene.h"

namespace sslcd {
namespace {

TEST(EstimateGround, FindsHeightAndTilt) {
  for (double tilt : {0., 0.02, -0.03}) {
    StereoScene scene;
    scene.tilt_rad = tilt;
    scene.Render();
    GroundOptions options;
    options.height_m = 1.4;
    const GroundPlane plane = EstimateGround(scene.view(), scene.camera, {}, options);
    EXPECT_NEAR(plane.height_m, 1.2, 0.02) << tilt;
    EXPECT_NEAR(plane.up.x(), 0, 2e-3) << tilt;
    EXPECT_NEAR(-plane.up.z(), std::sin(tilt), 2e-3) << tilt;
    EXPECT_NEAR(plane.up.norm(), 1, 1e-12);
    EXPECT_GT(plane.support, 0.8);
    EXPECT_NEAR(plane.HeightOf({0, 1.2 - 10 * std::tan(tilt), 10}), 0, 0.03) << tilt;
  }
}

TEST(EstimateGround, IsNotMovedByWhatStandsOnIt) {
  StereoScene scene;
  scene.Add(-2, 5, 0.3, {4, 1.8, 1.5});
  scene.Add(2.5, 7, 1.2, {4, 1.8, 1.5});
  scene.Render();
  const GroundPlane without = EstimateGround(scene.view(), scene.camera, {}, {});  // nobody says where they are
  EXPECT_NEAR(without.height_m, 1.2, 0.03);
  EXPECT_NEAR(without.up.z(), 0, 4e-3);
}

TEST(EstimateGround, WithoutEvidenceThePriorIsTheAnswer) {
  StereoScene scene;
  scene.Render();
  GroundOptions options;
  options.height_m = 1.4;
  const cv::Mat black(scene.left.size(), CV_8U, cv::Scalar(0));
  const Box2d all{0, 0, 640, 360};
  for (const GroundPlane& plane : {EstimateGround({ViewOf(black), ViewOf(black)}, scene.camera, {}, options),
                                   EstimateGround(scene.view(), scene.camera, {all}, options)}) {
    EXPECT_NEAR(plane.height_m, 1.4, 1e-9);
    EXPECT_EQ(plane.up, Vec3(0, -1, 0));
    EXPECT_EQ(plane.support, 0);
  }
  scene.camera.left.cy = 1000;  // no pixel looks down
  EXPECT_NEAR(EstimateGround(scene.view(), scene.camera, {}, options).height_m, 1.4, 1e-9);
}

TEST(FindGroundHeight, FromFarOff) {
  StereoScene scene;
  scene.Render();
  for (const double prior : {0.4, 1.2, 4.}) {
    GroundOptions options;
    options.height_m = prior;
    const std::optional<double> height = FindGroundHeight(scene.view(), scene.camera, {}, options);
    ASSERT_TRUE(height) << prior;
    EXPECT_NEAR(*height, 1.2, 0.06) << prior;
  }
  const cv::Mat black(scene.left.size(), CV_8U, cv::Scalar(0));
  EXPECT_FALSE(FindGroundHeight({ViewOf(black), ViewOf(black)}, scene.camera, {}, {}));
  EXPECT_THROW(FindGroundHeight({}, scene.camera, {}, {}), Error);
}

TEST(EstimateGround, SameBytesTwice) {
  StereoScene scene;
  scene.Render();
  const GroundPlane a = EstimateGround(scene.view(), scene.camera, {}, {});
  const GroundPlane b = EstimateGround(scene.view(), scene.camera, {}, {});
  EXPECT_EQ(a.height_m, b.height_m);
  EXPECT_EQ(a.up, b.up);
}

}  // namespace
}  // namespace sslcd
