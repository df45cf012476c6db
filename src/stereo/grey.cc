// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/grey.h"

#include <opencv2/imgproc.hpp>

#include "sslcd/perception/opencv_image.h"

namespace sslcd {

cv::Mat Grey(const ImageView& image) {
  CheckImage(image, "image");
  if (image.channels == 1) return MatOf(image);
  cv::Mat grey;
  cv::cvtColor(MatOf(image), grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace sslcd
