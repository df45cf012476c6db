// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>

#include "sslcd/core/camera.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// A patch of an image around a pixel.
struct Patch {
  cv::Mat grey;  ///< shared, not copied
  cv::Point2f at;
  Vec3 point;    ///< the point at the pixel in the camera's frame; for FindPatch
  int half = 4;  ///< the patch is 2 half + 1 pixels wide
};

/// The homography of a plane from one camera to another one with the same intrinsics: K (R + t n^T
/// / n.p) K^-1 (Hartley and Zisserman, Multiple view geometry, 13.1). `normal` n has any length;
/// `point` p is on the plane; both are in the frame of `from`. None: the point is not in front of
/// both cameras, or the plane is seen edge on.
std::optional<Eigen::Matrix3d> PlaneHomography(const Camera& camera, const Pose& T_to_from,
                                               const Vec3& point, const Vec3& normal);

/// The position of a patch in another image and its residual difference.
struct AlignedPatch {
  cv::Point2f at;
  double difference = 0;  ///< root mean square [grey values] after removing brightness
};

/// Aligns a patch near `guess`, warped by a homography; its brightness may change. Inverse
/// compositional Lucas-Kanade (Baker and Matthews, Lucas-Kanade 20 years on: a unifying framework,
/// IJCV 2004). None: the patch has no texture, is stretched too much, does not converge within 1.5
/// pixels of the guess, or is not entirely in both images.
std::optional<AlignedPatch> AlignPatch(const Patch& patch, const Eigen::Matrix3d& homography,
                                       const cv::Mat& to, const cv::Point2f& guess);

/// The same for a patch of unknown orientation: tries a patch that faces the camera and a level one
/// (the camera's y axis points down), and returns the more similar one. Without a warp, the change
/// of scale of an approaching patch would bias an asymmetric patch.
std::optional<cv::Point2f> FindPatch(const Patch& patch, const Camera& camera,
                                     const Pose& T_to_from, const cv::Mat& to,
                                     const cv::Point2f& guess);

}  // namespace sslcd
