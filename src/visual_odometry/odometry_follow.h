// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "stereo/bundle.h"
#include "stereo/image_pyramids.h"

namespace sslcd {

/// Side of the tracked patches [px]; 13 was no better on rendered images and on KITTI (docs/notes,
/// "Stereo odometry").
inline constexpr int kPatchPx = 9;
/// Smallest number of inliers of a tracked frame: several times the three points of a pose. Not
/// tuned.
inline constexpr int kMinTracked = 20;
/// Largest reprojection error of an inlier [px]: about four standard deviations of a tracked corner
/// (residuals of 0.46 to 0.53 px, docs/notes, "Which noise?").
inline constexpr double kFitsWithinPx = 2;
inline constexpr const char* kTooFewFound = "too few points of the last keyframe were found again";

/// The tracked points: those of a keyframe.
struct TrackedKeyframe {
  const StereoCamera& camera;
  const StereoFrame& keyframe;
  const OdometryPoints& points;
};

/// Estimates the pose T_odom_left by RANSAC on the points tracked from `from` (left image of the
/// keyframe) to `to` (current left image), with predictions from `T_guess`. None: `reason` has the
/// cause.
std::optional<Pose> FindPose(const TrackedKeyframe& tracked, const ImagePyramid& from,
                             const ImagePyramid& to, const Pose& T_guess, const char*& reason);

/// Makes a frame at that pose with all points that are found in its left image, and their columns
/// in the right one. `from` and `to` as above; their brightness may differ from `current`.
StereoFrame FindAll(const TrackedKeyframe& tracked, const ImagePyramid& from,
                    const ImagePyramid& to, const StereoPyramids& current, const Pose& T_odom_left);

/// Refines the right column of a point that is found in both images to a fraction of a pixel. None:
/// it is another point, or its patch has too little texture.
std::optional<StereoPixel> MeasurePair(const StereoCamera& camera, const StereoPyramids& images,
                                       const cv::Point2f& left, const cv::Point2f& right);

}  // namespace sslcd
