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

Image LoadImage(const std::string& path) {
  cv::Mat image;
  try {
    image = cv::imread(path, cv::IMREAD_ANYCOLOR);  // eight bits
  } catch (const cv::Exception&) {                  // a header that asks for too much
  }
  if (image.empty()) return {};
  Image copy{{}, image.cols, image.rows, image.channels()};
  for (int row = 0; row < image.rows; ++row)
    copy.pixels.insert(copy.pixels.end(), image.ptr(row), image.ptr(row) + image.cols * image.elemSize());
  return copy;
}

}  // namespace sslcd::apps
