// SPDX-License-Identifier: BSD-3-Clause
#include "ground/top_view.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace sslcd {
namespace {

GroundPlane Tilted(double pitch) {
  GroundPlane plane;
  plane.up = Vec3(0, -std::cos(pitch), -std::sin(pitch));
  plane.height_m = 1.2;
  return plane;
}

TEST(TopView, LevelOnPutsItsOriginOnTheGroundBelowTheCamera) {
  for (const double pitch : {0., 0.1, -0.05}) {
    const GroundPlane plane = Tilted(pitch);
    const Pose T_cam_ground = LevelOn(plane);
    EXPECT_NEAR(T_cam_ground.translation().norm(), 1.2, 1e-12) << pitch;
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(3, 0, 5), Vec3(-2, 0, 9)})
      EXPECT_NEAR(plane.HeightOf(T_cam_ground * p), 0, 1e-12) << pitch;
    EXPECT_NEAR(plane.HeightOf(T_cam_ground * Vec3(0, 1, 0)), -1, 1e-12) << "y points down";
    EXPECT_NEAR((T_cam_ground.so3() * Vec3(Vec3::UnitZ())).x(), 0, 1e-12)
        << "straight ahead remains so";
  }
}

// An image that is brighter the further to the right: each cell shows the column that it projects
// to.
TEST(TopView, ShowsWhatTheCameraSeesAtEachCell) {
  cv::Mat image(360, 640, CV_8U);
  for (int u = 0; u < image.cols; ++u) image.col(u) = u * 255 / 640;
  const Camera camera{450, 450, 319.5, 179.5, Vec3(0, 0, 0), 640, 360};
  const GroundGrid grid{-4, 2, 0.25, 33, 40};
  const Pose T_cam_ground = LevelOn(Tilted(0));
  const TopView view = SeeFromAbove(image, camera, T_cam_ground, grid);
  int seen = 0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Vec3 p = T_cam_ground * grid.At(column, row);
      const double u = camera.fx * p.x() / p.z() + camera.cx,
                   v = camera.fy * p.y() / p.z() + camera.cy;
      const double margin = 0.6 * grid.cell * camera.fx / (p.z() - grid.cell);
      if (view.seen.at<unsigned char>(row, column)) {
        ++seen;
        EXPECT_NEAR(view.grey.at<unsigned char>(row, column), u * 255 / 640, 2)
            << column << " " << row;
        EXPECT_TRUE(u > 0 && u < 640 && v < 360);
      } else {
        EXPECT_FALSE(u > margin && u < 639 - margin && v < 359 - 40) << column << " " << row;
      }
    }
  }
  EXPECT_GT(seen, 600);
}

TEST(TopView, SeesNothingBehindTheCamera) {
  const cv::Mat image(360, 640, CV_8U, cv::Scalar(100));
  const Camera camera{450, 450, 319.5, 179.5, Vec3(0, 0, 0), 640, 360};
  const TopView view =
      SeeFromAbove(image, camera, LevelOn(Tilted(0)) * Pose::RotY(M_PI), {-4, 2, 0.25, 33, 40});
  EXPECT_EQ(cv::countNonZero(view.seen), 0);
}

}  // namespace
}  // namespace sslcd
