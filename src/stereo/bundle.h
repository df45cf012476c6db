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
  /// What residuals (column, row, right column) are multiplied by: the square root of their
  /// information, to a factor that all sightings share. Lower triangular: without a right column,
  /// the last row does not count.
  Eigen::Matrix3d weight = Eigen::Matrix3d::Identity();
};

/// A frame and what is seen in it. Poses and points are those of the left camera, in the axes of
/// the first one.
struct StereoFrame {
  Pose T_odom_left;
  std::vector<StereoSighting> sightings;
};

using OdometryPoints = std::map<int, Vec3>;

/// How far the sighting is from where its point should appear, the largest of its coordinates.
/// Infinite for a point that is not in front of the camera. [px]
double StereoError(const StereoCamera& camera, const StereoFrame& frame,
                   const StereoSighting& sighting, const Vec3& point);

/// Moves the frame to where its sightings fit the points best (robust least squares: weighted
/// residuals of more than `loss` count for less and less); the points stay.
void RefinePose(const StereoCamera& camera, const OdometryPoints& points, double loss,
                StereoFrame& frame);

/// Bundle adjustment: moves all frames but the first `fixed` ones, and all points that are seen in
/// two frames or more. `loss` as above. `calibrate`: the camera's disparity at infinity, too, is
/// what fits best, and returned; else what it was. It shows, since points that come nearer by the
/// camera's motion must come nearer by their disparity, too.
double RefineWindow(const StereoCamera& camera, int fixed, const std::vector<StereoFrame*>& frames,
                    double loss, OdometryPoints& points, bool calibrate = false);

/// Standard deviations of the three weighted residuals, by their medians; 0 of what is not known of
/// any point.
Vec3 ResidualScale(const StereoCamera& camera, const StereoFrame& frame,
                   const OdometryPoints& points);

/// Covariance of T_from_to (right perturbation, [translation, rotation]), known from the points
/// that both see, whose places are known from these two frames alone; points are eliminated (Schur
/// complement). Weighted residuals have noise of `noise`, independently. Huge where there are too
/// few points.
Pose::Matrix6 StepCovariance(const StereoCamera& camera, const StereoFrame& from,
                             const StereoFrame& to, const OdometryPoints& points, double noise);

}  // namespace sslcd
