// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "sslcd/core/camera.h"
#include "sslcd/core/pose.h"
#include "sslcd/ground/ground_plane.h"

namespace sslcd {

/// T_cam_ground: a frame on the ground below the camera, x to the right, y down, z ahead.
Pose LevelOn(const GroundPlane& plane);

/// A rectangle of the ground in cells; a cell is one pixel of a top view. Rows run from near to
/// far.
struct GroundGrid {
  double left = 0, near = 0;  ///< centre of the first cell [m]
  double cell = 0;            ///< side [m]
  int columns = 0, rows = 0;

  Vec3 At(double column, double row) const { return {left + cell * column, 0, near + cell * row}; }
};

/// The ground seen from above.
struct TopView {
  cv::Mat grey;  ///< 8 bits
  cv::Mat seen;  ///< 8 bits: non-zero if the image shows the cell
};

/// Projects a camera's image onto a grid. `T_cam_ground` maps from the grid's frame to the
/// camera's; `grey` has 8 bits.
TopView SeeFromAbove(const cv::Mat& grey, const Camera& camera, const Pose& T_cam_ground,
                     const GroundGrid& grid);

}  // namespace sslcd
