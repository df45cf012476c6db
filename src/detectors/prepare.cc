// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/prepare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sslcd/core/error.h"
#include "sslcd/perception/opencv_image.h"

namespace sslcd {
namespace {

constexpr double kLetterboxGrey = 114;  // used in the training of YOLO

/// The size of an image after resizing, before cropping or padding.
cv::Size ResizedSize(cv::Size image, cv::Size input, ModelInput::Resize resize) {
  if (resize == ModelInput::Resize::kStretch) return input;
  const double by_width = static_cast<double>(input.width) / image.width;
  const double by_height = static_cast<double>(input.height) / image.height;
  const double scale =
      resize == ModelInput::Resize::kFitHeight ? by_height : std::min(by_width, by_height);
  return {std::max(1, static_cast<int>(std::lround(image.width * scale))),
          std::max(1, static_cast<int>(std::lround(image.height * scale)))};
}

/// Uses a table per channel, since a pixel has only 256 values.
void WritePlanes(const cv::Mat& image, const ModelInput& input, float* planes) {
  for (int channel = 0; channel < 3; ++channel) {
    std::array<float, 256> value;
    for (int i = 0; i < 256; ++i)
      value[i] = static_cast<float>((i * input.scale - input.mean[channel]) / input.std[channel]);
    const int source = input.channels == ModelInput::Channels::kRgb ? 2 - channel : channel;
    for (int y = 0; y < image.rows; ++y) {
      const unsigned char* pixel = image.ptr<unsigned char>(y) + source;
      for (int x = 0; x < image.cols; ++x, pixel += 3) *planes++ = value[*pixel];
    }
  }
}

}  // namespace

InputMap Prepare(const ImageView& image, const ModelInput& input, int width, int height,
                 const char* what, float* planes) {
  CheckImage(image, what);
  const auto refuse = [what](const std::string& why) {
    throw Error(ErrorKind::kBadInput, std::string(what) + ": " + why);
  };
  if (image.channels != 3) refuse("it is grey, the model needs colour (B G R)");
  if (image.height <= input.crop_top_px)
    refuse("it has " + std::to_string(image.height) + " rows, 'crop_top_px' cuts off " +
           std::to_string(input.crop_top_px));

  const cv::Mat pixels = MatOf(image).rowRange(input.crop_top_px, image.height);
  const cv::Size size = ResizedSize(pixels.size(), {width, height}, input.resize);
  cv::Mat resized;
  // as in the training of these models, although it aliases
  cv::resize(pixels, resized, size, 0, 0, cv::INTER_LINEAR);

  InputMap map;
  map.scale_x = static_cast<double>(size.width) / pixels.cols;
  map.scale_y = static_cast<double>(size.height) / pixels.rows;
  if (size != cv::Size(width, height)) {
    const bool centred = input.resize == ModelInput::Resize::kLetterbox;
    const double around = input.resize == ModelInput::Resize::kFitHeight ? 0 : kLetterboxGrey;
    const cv::Point corner =
        centred ? cv::Point((width - size.width) / 2, (height - size.height) / 2) : cv::Point();
    cv::Mat canvas(height, width, CV_8UC3, cv::Scalar::all(around));
    const cv::Rect inside = cv::Rect(corner, size) & cv::Rect(0, 0, width, height);
    resized(inside - corner).copyTo(canvas(inside));
    resized = canvas;
    map.offset_x = corner.x;
    map.offset_y = corner.y;
  }
  map.offset_y -= input.crop_top_px * map.scale_y;
  WritePlanes(resized, input, planes);
  return map;
}

}  // namespace sslcd
