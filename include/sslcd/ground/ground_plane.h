// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/image.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// The prior of the ground plane. The search covers three standard deviations.
struct GroundOptions {
  double height_m = 1.5, height_sigma_m = 0.3;  ///< height of the camera above the ground
  /// standard deviation of each of roll and pitch of the camera relative to the ground
  double tilt_sigma_rad = 0.03;
};
void DescribeFields(FieldVisitor& visitor, GroundOptions& options);

/// The plane `up . p + height = 0` in the left camera's frame.
struct GroundPlane {
  Vec3 up{0, -1, 0};    ///< unit vector
  double height_m = 0;  ///< height of the camera above the plane
  double support = 0;   ///< share of the examined pixels on the plane; 0: only the prior
  /// Height of a point in the left camera's frame over the plane. [m]
  double HeightOf(const Vec3& point_cam) const { return up.dot(point_cam) + height_m; }
};

/// Smallest support of a plane that is the ground. Streets and car parks had 0.5 to 0.95; searches
/// from two or three times the true height had 0 to 0.3.
inline constexpr double kGroundSupport = 0.3;

/// Estimates the ground in front of the camera as a plane in disparity (d = -f b up.ray / height is
/// linear in up / height): RANSAC in the lower part of the images outside of `objects`, then an
/// adjustment with the prior. Returns the prior if there is no evidence. Throws the errors of
/// CheckImages.
GroundPlane EstimateGround(const StereoView& images, const StereoCamera& camera,
                           const std::vector<Box2d>& objects, const GroundOptions& options);

/// Estimates the height of the camera if `options` may be wrong: runs EstimateGround with heights
/// from a quarter to four times `options.height_m` and returns the result with the largest support.
/// None: the support is less than kGroundSupport. [m]
std::optional<double> FindGroundHeight(const StereoView& images, const StereoCamera& camera,
                                       const std::vector<Box2d>& objects,
                                       const GroundOptions& options);

}  // namespace sslcd
