// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>

#include "sslcd/core/camera.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// What an image shows about a pixel.
struct Patch {
  cv::Mat grey;  ///< shared, not copied
  cv::Point2f at;
  Vec3 point;    ///< the place that the pixel shows, in the camera's axes; for FindPatch
  int half = 4;  ///< the patch is 2 half + 1 pixels wide
};

/// Homography that takes pixels of one camera, which show a plane, to pixels of another one with
/// the same intrinsics: K (R + t n^T / n.p) K^-1 (Hartley and Zisserman, Multiple view
/// geometry, 13.1). `normal` n of any length, `point` p of the plane, both in the axes of `from`.
/// None: the point is not in front of both, or the plane is seen edge on.
std::optional<Eigen::Matrix3d> PlaneHomography(const Camera& camera, const Pose& T_to_from,
                                               const Vec3& point, const Vec3& normal);

/// Where a patch is in another image, and how different it looks there.
struct AlignedPatch {
  cv::Point2f at;
  double difference = 0;  ///< root mean square [grey values], brightness left aside
};

/// Looks for a patch around `guess`, in the shape that a homography gives it; its brightness may
/// have changed. Lucas-Kanade in its inverse compositional form (Baker and Matthews, Lucas-Kanade
/// 20 years on: a unifying framework, IJCV 2004). None: it has no texture, is stretched beyond
/// recognition, does not settle within 1.5 pixels of the guess, or is not in either image as a
/// whole.
std::optional<AlignedPatch> AlignPatch(const Patch& patch, const Eigen::Matrix3d& homography,
                                       const cv::Mat& to, const cv::Point2f& guess);

/// The same for a patch of which only the distance is known: it faces the camera or lies level (its
/// y axis points down), whichever looks more alike. Left as it is, a patch that comes nearer is off
/// by as much as it is lopsided.
std::optional<cv::Point2f> FindPatch(const Patch& patch, const Camera& camera,
                                     const Pose& T_to_from, const cv::Mat& to,
                                     const cv::Point2f& guess);

}  // namespace sslcd
