// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/camera.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/image.h"
#include "sslcd/core/pose.h"
#include "sslcd/ground/ground_plane.h"

namespace SSLCD_EXPORT sslcd {

struct GroundAlignmentOptions {
  /// largest error of the guess in each direction; a larger value leaves less ground to compare
  double search_m = 0.6;
  /// alignments whose position has a larger standard deviation are rejected
  double max_sigma_m = 0.2;
};
void DescribeFields(FieldVisitor& visitor, GroundAlignmentOptions& options);

/// The best distance [m] of the ground ahead of two cameras that face each other, for AlignGround
/// and LoopViewOptions::ahead_m. Near ground gives better measurements, but both cameras must see
/// some metres of it. `rows` is the number of image rows, `height_m` the height of the camera over
/// the ground. None: the camera sees no level ground within 12 m.
std::optional<double> AlignmentRange(const Camera& camera, int rows, double height_m);

/// Estimates the pose of the second stereo camera in the frame of the first one (reference cameras,
/// see Camera::offset) from the ground that both see, from any viewing directions. Both left images
/// are projected onto the plane of the ground (EstimateGround), where cracks, stains and markings
/// look the same from any side. Patches of the first top view are searched in the second one by
/// normalised correlation. The consensus of the patches gives corresponding pixels. Bundle
/// adjustment of these points and the pose in all four images follows, so the ground need not be a
/// plane. None: the guess is too wrong, or too little ground matches. The pairs may have different
/// times: patches that have moved or changed are outliers. Throws the errors of CheckImages and
/// CheckSize.
std::optional<RelativePose> AlignGround(const StereoView& a, const StereoView& b,
                                        const StereoCamera& camera, const Pose& T_a_b_guess,
                                        const GroundOptions& ground,
                                        const GroundAlignmentOptions& options);

}  // namespace sslcd
