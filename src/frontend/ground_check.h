// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/frontend/image_frontend.h"

namespace sslcd {

/// Looks whether the ground of a frame is where `options` has it: supported, and no more than three
/// standard deviations higher or lower. Of the first few frames where it is not, looks where it is.
void CheckGround(const StereoView& images, const StereoCamera& camera,
                 const std::vector<Detection>& objects, const GroundOptions& options,
                 GroundReport& report);

}  // namespace sslcd
