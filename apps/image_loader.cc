// SPDX-License-Identifier: BSD-3-Clause
#include "image_loader.h"

#include <opencv2/imgcodecs.hpp>

#include "sslcd/core/log.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd::apps {

bool WithImage(const std::string& path, const std::function<void(const ImageView&)>& use) {
  const cv::Mat image = cv::imread(path, cv::IMREAD_COLOR);
  if (image.empty()) {
    Log(LogLevel::kWarning, path + ": no image that can be read; its frame goes without colour");
    return false;
  }
  use(ViewOf(image));
  return true;
}

}  // namespace sslcd::apps
