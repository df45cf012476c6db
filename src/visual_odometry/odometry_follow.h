// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "stereo/bundle.h"
#include "stereo/image_pyramids.h"

namespace sslcd {

/// Side of the patches that the odometry follows [px]; 13 were no better on rendered images and on
/// KITTI (docs/notes, "Stereo odometry").
inline constexpr int kPatchPx = 9;
/// Points that must be followed and fit, or a frame is lost: several times the three that a pose
/// takes. Not tuned.
inline constexpr int kMinTracked = 20;
/// A point fits a pose if it appears this near to where it should [px]: some four standard
/// deviations of a followed corner (residuals of 0.46 to 0.53 px, docs/notes, "Which noise?").
inline constexpr double kFitsWithinPx = 2;
inline constexpr const char* kTooFewFound = "too few points of the last keyframe were found again";

/// What is followed: the points that a keyframe sees.
struct Following {
  const StereoCamera& camera;
  const StereoFrame& keyframe;
  const OdometryPoints& points;
};

/// The pose T_odom_left that most points agree on when they are looked for around where they appear
/// from `T_guess`. `from`, `to`: left images of the keyframe and of now. None: `reason` says why.
std::optional<Pose> FindPose(const Following& following, const ImagePyramid& from,
                             const ImagePyramid& to, const Pose& T_guess, const char*& reason);

/// A frame at that pose with all points that are found in its left image, and where those are in
/// its right one. `from` and `to` as above; they may differ in light from `current`.
StereoFrame FindAll(const Following& following, const ImagePyramid& from, const ImagePyramid& to,
                    const StereoPyramids& current, const Pose& T_odom_left);

/// A point that has been found in both images, its column in the right one to a fraction of a
/// pixel. None: it is not the same point, or its patch does not tell.
std::optional<StereoPixel> MeasurePair(const StereoCamera& camera, const StereoPyramids& images,
                                       const cv::Point2f& left, const cv::Point2f& right);

}  // namespace sslcd
