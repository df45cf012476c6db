// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/image.h"

namespace sslcd::apps {

/// Draws the boxes and cuboids of a frame over its left image. Throws Error(kOutput).
void WriteOverlay(const std::string& path, const Frame& frame, const ImageView& left, const Camera& camera);

}  // namespace sslcd::apps
