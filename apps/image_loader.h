// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "sslcd/core/image.h"

namespace sslcd::apps {

/// RunHooks::with_image: reads an image file and hands it on; false, with a warning, where that
/// fails.
bool WithImage(const std::string& path, const std::function<void(const ImageView&)>& use);

/// FrontendHooks::load: an image file, in colour or grey as it is; empty where that fails.
Image LoadImage(const std::string& path);

}  // namespace sslcd::apps
