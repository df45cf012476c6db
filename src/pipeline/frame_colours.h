// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/pipeline/run.h"

namespace sslcd {

/// Whether a frame has an image, and a detection with a box and without a colour.
bool LacksColour(const Frame& frame);

/// Computes the colour vectors of these detections by RunHooks::with_image. False: the image cannot
/// be read.
bool AddColours(Frame& frame, const ColourOptions& options, const RunHooks& hooks);

}  // namespace sslcd
