// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map/map_landmark.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"

namespace sslcd {

/// Updates each component of `scale` so that the median of the absolute errors converges to that of
/// a Gaussian with this scale (Robbins and Monro, A stochastic approximation method, 1951). `noise`
/// is the detector's noise for a scale of 1. The error is the difference of `detection`, seen from
/// T_world_cam, and the landmark's pose, with the yaw modulo half a turn and without a yaw for
/// symmetric landmarks.
void LearnNoise(const MapLandmark& landmark, const Detection& detection, const Pose& T_world_cam,
                const GravityFrame& gravity, const DetectionNoise& noise, NoiseScale& scale);

}  // namespace sslcd
