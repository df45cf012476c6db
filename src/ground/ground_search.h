// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/ground/ground_plane.h"
#include "stereo/disparity.h"

namespace sslcd {

/// EstimateGround for grey images.
GroundPlane EstimateGround(const GreyPair& grey, const StereoCamera& camera,
                           const std::vector<Box2d>& objects, const GroundOptions& options);

}  // namespace sslcd
