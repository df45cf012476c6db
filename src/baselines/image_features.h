// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "baselines/appearance.h"
#include "baselines/bag_of_words.h"
#include "sslcd/core/camera.h"

namespace sslcd::baselines {

/// ORB features of a rectified stereo pair.
struct ImageFeatures {
  std::vector<Vec2> pixels;                   ///< in the left image
  std::vector<BinaryDescriptor> descriptors;  ///< in step
  /// in the left camera, where the right image has the feature, too [m]
  std::vector<std::optional<Vec3>> points;
};

/// Upright features: cameras are not rolled, and descriptors that need not turn tell more apart
/// (BRIEF, Calonder et al. 2010, which VINS-Fusion uses). Depth by tracking each from left to right
/// and back (Lucas and Kanade, as in VINS-Fusion), to a fraction of a pixel. Throws
/// Error(kBadInput) on an image that cannot be read, or a pair of different sizes.
ImageFeatures ExtractFeatures(const std::string& left, const std::string& right,
                              const StereoCamera& stereo, const AppearanceOptions& options);

/// Where the camera of `query` stands in that of `old`, and how many points agree. None: too few
/// matches, or no pose. Matches are each other's nearest; a pose by RANSAC; then, as ORB-SLAM's
/// loop closing does, all points of `old` are searched for where that pose has them, which finds
/// several times as many.
struct ImagePose {
  Pose T_old_query;
  int inliers = 0;
};
std::optional<ImagePose> PoseFromImages(const ImageFeatures& query, const ImageFeatures& old,
                                        const Camera& camera, const AppearanceOptions& options);

}  // namespace sslcd::baselines
