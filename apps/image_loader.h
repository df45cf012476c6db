// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "sslcd/perception/colour.h"

namespace sslcd::apps {

/// Loads an image with OpenCV and hands it on; false (and a warning) when it cannot be read.
bool WithImage(const std::string& path, const std::function<void(const ImageView&)>& use);

}  // namespace sslcd::apps
