// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "sslcd/core/image.h"

namespace sslcd {

/// Converts an image to grey. A grey image is not copied.
cv::Mat Grey(const ImageView& image);

}  // namespace sslcd
