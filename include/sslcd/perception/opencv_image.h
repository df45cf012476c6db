// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "sslcd/core/export.h"
#include "sslcd/core/image.h"

namespace SSLCD_EXPORT sslcd {

/// Conversions for hosts with OpenCV. They copy nothing: the source must outlive the result.
inline ImageView ViewOf(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, image.step, image.channels()};
}

/// The result must not be written to.
inline cv::Mat MatOf(const ImageView& image) {
  return {image.height, image.width, CV_8UC(image.channels), const_cast<unsigned char*>(image.data),
          image.stride};
}

}  // namespace sslcd
