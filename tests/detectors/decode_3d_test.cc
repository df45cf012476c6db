// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/decode_3d.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "../inference/test_models.h"
#include "../support/temp_folder.h"
#include "formats/npy.h"
#include "perception/projection.h"
#include "sslcd/detectors/detector_3d.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {
namespace {

TEST(CuboidInCamera, LooksAtTheCameraWhereverItStands) {
  Camera camera;
  camera.fx = camera.fy = 700;
  camera.cx = 600;
  camera.cy = 180;
  camera.offset = {0.06, 0, 0};
  for (const double u : {100., 600., 1100.}) {
    ClassCuboid cuboid;
    cuboid.centre_x = u;
    cuboid.centre_y = 200;
    cuboid.depth_m = 20;
    cuboid.alpha_rad = std::acos(-1.) / 2;  // KITTI: coming towards the camera
    cuboid.dims = {4, 1.7, 1.5};
    const Detection detection = CuboidInCamera(cuboid, camera);
    const Vec3 ahead = detection.T_cam_object.rotation() * Vec3(1, 0, 0);
    Vec3 to_camera = -detection.T_cam_object.translation();
    to_camera.y() = 0;
    EXPECT_NEAR(ahead.dot(to_camera.normalized()), 1, 1e-9);
    EXPECT_NEAR((detection.T_cam_object.rotation() * Vec3(0, 0, 1)).y(), -1, 1e-9) << "its z is up";
    const auto box =
        ProjectCuboid(Pose(detection.T_cam_object.rotation(), detection.T_cam_object.translation()),
                      Vec3(1e-6, 1e-6, 1e-6), camera);
    ASSERT_TRUE(box);
    EXPECT_NEAR(box->left, u, 1e-3)
        << "seen by the left camera, which stands beside the reference camera";
  }
}

TEST(CameraOfInput, SeesTheSamePointsInTheInput) {
  Camera camera;
  camera.fx = 700;
  camera.fy = 710;
  camera.cx = 600;
  camera.cy = 180;
  const InputMap map{0.5, 2, 3, -40};
  const Camera seen = CameraOfInput(camera, map);
  const Vec3 point(1, 0.5, 10);
  const Vec2 direct = map.ToInput(700 * 0.1 + 600, 710 * 0.05 + 180);
  EXPECT_DOUBLE_EQ(seen.fx * 0.1 + seen.cx, direct.x());
  EXPECT_DOUBLE_EQ(seen.fy * 0.05 + seen.cy, direct.y());
}

TEST(AnchorPriors, RefusesFilesOfAnotherSize) {
  const TempFolder folder;
  ModelOutput output;
  output.labels = {{0, "Car"}};
  output.anchors.scales = {1, 2};
  const NpyMatrix five{5, 6, std::vector<float>(30)};
  output.anchors.mean_files[0] = output.anchors.std_files[0] =
      folder.Write("mean.npy", NpyBytes(five));
  ExpectError([&] { LoadAnchorPriors(output); }, {"mean.npy", "is 5x6, the anchors need 6x6"});
  output.anchors.mean_files[0] = "/nowhere/mean.npy";
  ExpectError([&] { LoadAnchorPriors(output); }, {"/nowhere/mean.npy"});
}

class MonoFlexMaps : public testing::Test {
 protected:
  static Tensor Map(int channels, int rows, int columns, float value) {
    Tensor map{{1, channels, rows, columns}, {}};
    map.values.assign(ElementCount(map.shape), value);
    return map;
  }
  ModelOutput output = [] {
    ModelOutput o;
    o.layout = ModelLayout::kMonoFlex;
    o.class_count = 1;
    o.labels = {{0, "Car"}};
    return o;
  }();
  std::vector<Tensor> maps = {Map(1, 2, 3, 0), Map(2, 2, 3, 0), Map(1, 2, 3, 10), Map(3, 2, 3, 1),
                              Map(8, 2, 3, 0)};
};

TEST_F(MonoFlexMaps, FindsNothingInNothing) {
  EXPECT_TRUE(DecodeMonoFlex(maps, output, 12).empty());
}

TEST_F(MonoFlexMaps, RotationWithoutBins) {
  maps[0].values[4] = 0.9f;
  maps[4] = Map(2, 2, 3, 0);
  maps[4].values[4] = -0.5f;  // sin
  const std::vector<ClassCuboid> found = DecodeMonoFlex(maps, output, 12);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].alpha_rad, -std::acos(-1.) / 2);
  EXPECT_DOUBLE_EQ(found[0].centre_x, 4) << "cell 1 of 4 px";
  EXPECT_DOUBLE_EQ(found[0].centre_y, 4);
}

TEST_F(MonoFlexMaps, RefusesMapsThatDoNotFitTogether) {
  maps[2] = Map(1, 4, 3, 10);
  ExpectError([&] { DecodeMonoFlex(maps, output, 12); }, {"1x1x4x3", "1x1x2x3"});
  maps[2] = Map(1, 2, 3, 10);
  maps[4] = Map(9, 2, 3, 0);
  ExpectError([&] { DecodeMonoFlex(maps, output, 12); },
              {"1x9x2x3", "1x2x?x?, 1x8x?x? or 1x16x?x?"});
}

TEST(Detector3d, RefusesWhatItCannotUse) {
  SSLCD_RUNTIME();
  const Detector3d detector = Detector3d::Load(TestModel("stereo3d.yaml"));
  const cv::Mat left(48, 64, CV_8UC3, cv::Scalar::all(9)),
      small(40, 64, CV_8UC3, cv::Scalar::all(9));
  const cv::Mat grey(48, 64, CV_8UC1, cv::Scalar(9));
  ExpectError([&] { detector.Detect({ViewOf(left), {}}, {}); }, {"right image", "empty"});
  ExpectError([&] { detector.Detect({ViewOf(left), ViewOf(small)}, {}); }, {"64x48", "64x40"});
  ExpectError(
      [&] {
        detector.Detect({ViewOf(left), ViewOf(grey)}, {});
      },
      {"right image", "needs colour"});
}

}  // namespace
}  // namespace sslcd
