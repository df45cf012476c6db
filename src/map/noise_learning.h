// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map/map_landmark.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"

namespace sslcd {

/// Moves each component of `scale` a little towards where half of all detections are off by more
/// than the median of a Gaussian of that scale, and half by less (Robbins and Monro, A stochastic
/// approximation method, 1951). `noise`: the detector's noise for a scale of 1. The error is that
/// of `detection`, seen from T_world_cam, against the landmark's pose; in yaw modulo half a turn,
/// and none in yaw for a landmark without one.
void LearnNoise(const MapLandmark& landmark, const Detection& detection, const Pose& T_world_cam,
                const GravityFrame& gravity, const DetectionNoise& noise, NoiseScale& scale);

}  // namespace sslcd
