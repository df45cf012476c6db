// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "sslcd/core/image.h"

namespace sslcd {

/// A grey image of a colour one; of a grey one the same pixels, not copied.
cv::Mat Grey(const ImageView& image);

}  // namespace sslcd
