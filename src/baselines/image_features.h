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
  std::vector<BinaryDescriptor> descriptors;  ///< in the same order
  /// position in the left camera, if the right image also has the feature [m]
  std::vector<std::optional<Vec3>> points;
};

/// Detects upright features: cameras do not roll, and descriptors without rotation are more
/// distinctive (BRIEF, Calonder et al. 2010, used by VINS-Fusion). Their depth comes from tracking
/// from left to right and back (Lucas and Kanade, as in VINS-Fusion), to a fraction of a pixel.
/// Throws Error(kBadInput) if an image cannot be read or the sizes differ.
ImageFeatures ExtractFeatures(const std::string& left, const std::string& right,
                              const StereoCamera& stereo, const AppearanceOptions& options);

/// Estimates the pose of the camera of `query` in the camera of `old` and counts the inliers. Takes
/// mutual nearest neighbours and a pose by RANSAC. Then it searches all points of `old` at their
/// predicted pixels, like ORB-SLAM's loop closing, which gives several times as many matches. None:
/// too few matches, or no pose.
struct ImagePose {
  Pose T_old_query;
  int inliers = 0;
};
std::optional<ImagePose> PoseFromImages(const ImageFeatures& query, const ImageFeatures& old,
                                        const Camera& camera, const AppearanceOptions& options);

}  // namespace sslcd::baselines
