// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/image.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// What is known of the ground before an image is seen. The standard deviations also bound the
/// search: no ground is found more than three of them away.
struct GroundOptions {
  double height_m = 1.5, height_sigma_m = 0.3;  ///< of the camera above the ground
  /// of the camera against the ground, each of roll and pitch
  double tilt_sigma_rad = 0.03;
};
void DescribeFields(FieldVisitor& visitor, GroundOptions& options);

/// The plane `up . p + height = 0` in the left camera's frame.
struct GroundPlane {
  Vec3 up{0, -1, 0};    ///< unit vector
  double height_m = 0;  ///< of the camera above it
  double support = 0;   ///< share of the pixels looked at that lie on it; 0: nothing but the prior
  double HeightOf(const Vec3& point_cam) const { return up.dot(point_cam) + height_m; }
};

/// With less support than this a plane is hardly the ground. Streets and car parks had 0.5 to 0.95,
/// from heights twice and three times the true one 0 to 0.3.
inline constexpr double kGroundSupport = 0.3;

/// The ground in front of the camera: a plane in disparity (d = -f b up.ray / height is linear in
/// up / height), found by RANSAC in the lower part of the images outside of `objects`, then
/// adjusted together with the prior. Where there is no evidence the prior is the answer. Throws
/// Error(kBadInput) as CheckImages does.
GroundPlane EstimateGround(const StereoView& images, const StereoCamera& camera,
                           const std::vector<Box2d>& objects, const GroundOptions& options);

/// How high the camera stands where `options` may be far off: EstimateGround from heights of a
/// quarter to four times `options.height_m`, the one with the largest support; none where that is
/// less than kGroundSupport.
std::optional<double> FindGroundHeight(const StereoView& images, const StereoCamera& camera,
                                       const std::vector<Box2d>& objects,
                                       const GroundOptions& options);

}  // namespace sslcd
