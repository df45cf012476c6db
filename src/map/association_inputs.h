// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "association/associate.h"
#include "map/map_landmark.h"
#include "sslcd/core/camera.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/map/options.h"

namespace sslcd {

/// Gates and the motion test use larger sigmas than the learnt ones. kNoiseCaution is a factor on
/// them: errors vary with range and viewpoint, so successive errors correlate. kLongTailScale is
/// added in quadrature: errors of good detectors have long tails. Both were set by hand without a
/// recorded search.
inline constexpr double kNoiseCaution = 1.5, kLongTailScale = 3.;

/// A frame whose detections are associated.
struct FrameView {
  int frame = 0;
  double stamp = 0;        ///< [s]
  double travelled_m = 0;  ///< path length so far
  Pose T_world_cam;
  const Camera* camera = nullptr;  ///< null: association does not use 2D boxes
};

/// What association compares of a detection. The query refers to the detection.
AssociationQuery QueryOf(const Detection& detection, const Pose& T_world_cam,
                         const GravityFrame& gravity, const DetectionNoise& noise,
                         const NoiseScale& scale);

/// What association compares of a landmark as the frame should see it. The candidate refers to the
/// landmark's appearance.
AssociationCandidate CandidateOf(const MapLandmark& landmark, const FrameView& view,
                                 const GravityFrame& gravity, const MotionTestOptions& motion);

}  // namespace sslcd
