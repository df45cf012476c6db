// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/frontend/image_frontend.h"

namespace sslcd {

/// Checks the ground of a frame against `options`: the plane has support and its height is within
/// three standard deviations. Estimates the height in the first few frames that fail.
void CheckGround(const StereoView& images, const StereoCamera& camera,
                 const std::vector<Detection>& objects, const GroundOptions& options,
                 GroundReport& report);

}  // namespace sslcd
