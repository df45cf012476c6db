// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/camera.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/image.h"
#include "sslcd/core/pose.h"
#include "sslcd/ground/ground_plane.h"

namespace sslcd {

struct GroundAlignmentOptions {
  /// how far off the guess may be in each direction; with more of it, less ground is compared
  double search_m = 0.6;
  /// an alignment whose position has a larger standard deviation is none
  double max_sigma_m = 0.2;
};
void DescribeFields(FieldVisitor& visitor, GroundAlignmentOptions& options);

/// How far ahead of both of two cameras that face each other the ground should lie that AlignGround
/// looks at. It is measured the better the nearer it is, but both must see some metres of it. [m]
/// `rows`: of the image; `height_m`: of the camera over the ground. None: the camera sees no level
/// ground within 12 m. It is for LoopViewOptions::ahead_m.
std::optional<double> AlignmentRange(const Camera& camera, int rows, double height_m);

/// Where the second stereo camera stands in the first one's frame (reference cameras, see
/// Camera::offset), by the ground that both see, from whichever sides: cracks, stains and markings
/// look alike from above. Both left images are seen from above by the planes of the ground
/// (EstimateGround), and patches of the one are looked for in the other by normalised correlation.
/// What most of them agree on tells which pixels show the same places; from there on it is bundle
/// adjustment of these places and the pose in all four images, so the ground need not be a plane.
/// None where the guess is too far off or too little ground looks alike. The two may have been
/// taken at different times: what has moved or lies in another light finds no partner, or not that
/// of the others. Throws Error(kBadInput) as CheckImages and CheckSize do.
std::optional<RelativePose> AlignGround(const StereoView& a, const StereoView& b,
                                        const StereoCamera& camera, const Pose& T_a_b_guess,
                                        const GroundOptions& ground,
                                        const GroundAlignmentOptions& options);

}  // namespace sslcd
