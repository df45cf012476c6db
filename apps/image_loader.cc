// SPDX-License-Identifier: BSD-3-Clause
#include "image_loader.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "datasets/image_size.h"
#include "formats/raw_image.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd::apps {

namespace {

constexpr double kMostPixels = 1 << 26;  // of an image; a file of 3 MB may claim a thousand million

cv::Mat ReadRaw(const std::string& path, int flags) {
  try {
    const Image image = ReadRawImage(path);
    cv::Mat copy = MatOf(image.view()).clone();
    if (flags == cv::IMREAD_COLOR && image.channels == 1)
      cv::cvtColor(copy, copy, cv::COLOR_GRAY2BGR);
    return copy;
  } catch (const Error& error) {
    Log(LogLevel::kWarning, error.what());
    return {};
  }
}

/// Reads the pixels as stored, since the calibration is for these; a JPEG's orientation tag is
/// ignored. Empty if the file cannot be read, is neither PNG nor JPEG, or is too large: what a file
/// of any other format holds would go to OpenCV's other decoders. BMP and TIFF are read by
/// formats/raw_image.h; why one of them cannot be read goes to the log.
cv::Mat Read(const std::string& path, int flags) {
  if (IsRawImage(path)) return ReadRaw(path, flags);
  const ImageSize size = ReadImageSize(path);
  const double pixels = static_cast<double>(size[0]) * size[1];
  if (!(pixels > 0 && pixels <= kMostPixels)) return {};
  try {
    return cv::imread(path, flags | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {  // a header that asks for too much
    return {};
  }
}

}  // namespace

bool WithImage(const std::string& path, const std::function<void(const ImageView&)>& use) {
  const cv::Mat image = Read(path, cv::IMREAD_COLOR);
  if (image.empty()) {
    Log(LogLevel::kWarning, path + ": no image that can be read; its frame goes without colour");
    return false;
  }
  use(ViewOf(image));
  return true;
}

Image LoadImage(const std::string& path) {
  const cv::Mat image = Read(path, cv::IMREAD_ANYCOLOR);  // eight bits
  if (image.empty()) return {};
  Image copy{{}, image.cols, image.rows, image.channels()};
  for (int row = 0; row < image.rows; ++row)
    copy.pixels.insert(copy.pixels.end(), image.ptr(row),
                       image.ptr(row) + image.cols * image.elemSize());
  return copy;
}

}  // namespace sslcd::apps
