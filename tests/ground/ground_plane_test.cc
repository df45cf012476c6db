// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/ground/ground_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sslcd/core/error.h"
#include "stereo/stereo_scene.h"

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
  // without their boxes
  const GroundPlane without = EstimateGround(scene.view(), scene.camera, {}, {});
  EXPECT_NEAR(without.height_m, 1.2, 0.03);
  EXPECT_NEAR(without.up.z(), 0, 4e-3);
}

/// Three cars in a row across the street.
void AddCars(double z, StereoScene& scene) {
  for (const double x : {-5., 0., 5.}) scene.Add(x, z, 0.2, {4, 1.8, 1.5});
}

TEST(EstimateGround, FarGroundWithLittleTextureIsNotTiltedByItsSurroundings) {
  StereoScene scene;
  scene.fade_m = 10;
  AddCars(7, scene);
  scene.Render();
  const std::vector<Box2d> cars{scene.BoxOf(0), scene.BoxOf(1), scene.BoxOf(2)};
  const GroundPlane plane = EstimateGround(scene.view(), scene.camera, cars, {});
  EXPECT_NEAR(plane.up.z(), 0, 1e-3);
  EXPECT_NEAR(plane.height_m, 1.2, 4e-3);
}

TEST(EstimateGround, BlurredEdgesOfCarsDoNotTiltIt) {
  StereoScene scene;
  AddCars(9, scene);
  scene.Render();
  for (cv::Mat* image : {&scene.left, &scene.right}) cv::GaussianBlur(*image, *image, {}, 1);
  const GroundPlane without = EstimateGround(scene.view(), scene.camera, {}, {});
  EXPECT_NEAR(without.up.z(), 0, 1e-3);
  EXPECT_NEAR(without.height_m, 1.2, 4e-3);
}

TEST(EstimateGround, WithoutGroundItKeepsToWhatThePriorAllows) {
  StereoScene scene;
  scene.fade_m = 1;  // as good as none, and a wall of cars
  AddCars(9, scene);
  scene.Render();
  const GroundOptions options;
  const GroundPlane plane = EstimateGround(scene.view(), scene.camera, {}, options);
  EXPECT_LE(std::hypot(plane.up.x(), plane.up.z()), 3 * options.tilt_sigma_rad);
  EXPECT_NEAR(plane.height_m, options.height_m, 3 * options.height_sigma_m);
}

TEST(EstimateGround, WithoutEvidenceThePriorIsTheAnswer) {
  StereoScene scene;
  scene.Render();
  GroundOptions options;
  options.height_m = 1.4;
  const cv::Mat black(scene.left.size(), CV_8U, cv::Scalar(0));
  const Box2d all{0, 0, 640, 360};
  for (const GroundPlane& plane :
       {EstimateGround({ViewOf(black), ViewOf(black)}, scene.camera, {}, options),
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
