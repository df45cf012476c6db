// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/pose.h"
#include "stereo/geometry.h"

namespace sslcd {

/// A point seen in a frame. `point` is its number among all points of the odometry.
struct StereoSighting {
  int point = 0;
  StereoPixel pixel;
  /// Square root of the information of the residuals (column, row, right column), up to a factor
  /// common to all sightings. Lower triangular, so the last row drops out without a right column.
  Eigen::Matrix3d weight = Eigen::Matrix3d::Identity();
};

/// A frame and its sightings. Poses of the left camera and points are in the frame of the first
/// left camera.
struct StereoFrame {
  Pose T_odom_left;
  std::vector<StereoSighting> sightings;
};

using OdometryPoints = std::map<int, Vec3>;

/// Largest coordinate of the reprojection error of a sighting [px]. Infinite for a point that is
/// not in front of the camera.
double StereoError(const StereoCamera& camera, const StereoFrame& frame,
                   const StereoSighting& sighting, const Vec3& point);

/// Optimises the pose of the frame by robust least squares with fixed points. `loss` is the scale
/// of the loss on weighted residuals.
void RefinePose(const StereoCamera& camera, const OdometryPoints& points, double loss,
                StereoFrame& frame);

/// Bundle adjustment of all frames except the first `fixed` ones and of all points with two or more
/// sightings. `loss` as above. `calibrate` also estimates the camera's disparity at infinity, which
/// the relation of motion and disparity makes observable. Returns the disparity at infinity.
double RefineWindow(const StereoCamera& camera, int fixed, const std::vector<StereoFrame*>& frames,
                    double loss, OdometryPoints& points, bool calibrate = false);

/// Standard deviations of the three weighted residuals, from their medians; 0 if no point has the
/// component.
Vec3 ResidualScale(const StereoCamera& camera, const StereoFrame& frame,
                   const OdometryPoints& points);

/// Covariance of T_from_to (right perturbation, [translation, rotation]) from the points that both
/// frames see, located by these two frames alone and eliminated (Schur complement). `noise` is the
/// standard deviation of the independent weighted residuals. Very large for too few points.
Pose::Matrix6 StepCovariance(const StereoCamera& camera, const StereoFrame& from,
                             const StereoFrame& to, const OdometryPoints& points, double noise);

}  // namespace sslcd
