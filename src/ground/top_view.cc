// SPDX-License-Identifier: BSD-3-Clause
#include "ground/top_view.h"

#include <opencv2/imgproc.hpp>

namespace sslcd {

Pose LevelOn(const GroundPlane& plane) {
  const Vec3 down = -plane.up, ahead = (Vec3::UnitZ() - plane.up.z() * plane.up).normalized();
  Eigen::Matrix3d axes;
  axes << down.cross(ahead), down, ahead;
  return {lie::SO3<double>::FromMatrix(axes), down * plane.height_m};
}

TopView SeeFromAbove(const cv::Mat& grey, const Camera& camera, const Pose& T_cam_ground,
                     const GroundGrid& grid) {
  // samples per cell in each direction, since near image pixels are smaller than a cell
  constexpr int kFiner = 2;
  constexpr double kNearest = 0.5;  // [m] in front of the camera; set by hand
  const int columns = kFiner * grid.columns, rows = kFiner * grid.rows;
  cv::Mat at(rows, columns, CV_32FC2), seen(rows, columns, CV_8U, cv::Scalar(0));
  const Eigen::Matrix3d R = T_cam_ground.so3().matrix();
  for (int row = 0; row < rows; ++row) {
    auto* const pixel = at.ptr<cv::Vec2f>(row);
    auto* const inside = seen.ptr<unsigned char>(row);
    const auto middle = [](int i) { return (i + 0.5) / kFiner - 0.5; };
    Vec3 p = R * grid.At(middle(0), middle(row)) + T_cam_ground.translation();
    const Vec3 step = R.col(0) * (grid.cell / kFiner);
    for (int column = 0; column < columns; ++column, p += step) {
      pixel[column] = {-1, -1};
      if (!(p.z() > kNearest)) continue;
      const double u = camera.fx * p.x() / p.z() + camera.cx,
                   v = camera.fy * p.y() / p.z() + camera.cy;
      if (!(u >= 0 && v >= 0 && u <= grey.cols - 1 && v <= grey.rows - 1)) continue;
      pixel[column] = {static_cast<float>(u), static_cast<float>(v)};
      inside[column] = 255;
    }
  }
  TopView view;
  cv::Mat fine;
  cv::remap(grey, fine, at, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::resize(fine, view.grey, {grid.columns, grid.rows}, 0, 0, cv::INTER_AREA);
  cv::resize(seen, view.seen, {grid.columns, grid.rows}, 0, 0, cv::INTER_AREA);
  view.seen = view.seen == 255;
  return view;
}

}  // namespace sslcd
