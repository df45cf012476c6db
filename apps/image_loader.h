// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "sslcd/core/image.h"

namespace sslcd::apps {

/// RunHooks::with_image: reads an image file and passes it to the callback. Logs a warning and
/// returns false on failure.
bool WithImage(const std::string& path, const std::function<void(const ImageView&)>& use);

/// FrontendHooks::load: reads an image file, in colour or grey as stored. Empty on failure.
Image LoadImage(const std::string& path);

}  // namespace sslcd::apps
