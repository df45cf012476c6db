// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/disparity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace sslcd {
namespace {

constexpr int kBlock = 5;

cv::Mat Scaled(const cv::Mat& image, double scale_x, double scale_y) {
  if (scale_x == 1 && scale_y == 1) return image.clone();  // the matcher reads beyond the edges of a part
  cv::Mat scaled;
  const bool smaller = scale_x < 1;
  cv::resize(image, scaled, {}, scale_x, scale_y, smaller ? cv::INTER_AREA : cv::INTER_CUBIC);
  return scaled;
}

}  // namespace

DisparityPatch MatchInside(const GreyPair& images, const Box2d& box, double max_disparity, double scale_x,
                           double scale_y) {
  const int width = images.left.cols, height = images.left.rows;
  const auto clamp = [](double value, int most) { return static_cast<int>(std::clamp<double>(value, 0, most)); };
  const int left = clamp(std::floor(box.left), width), right = clamp(std::ceil(box.right), width);
  const int top = clamp(std::floor(box.top), height), bottom = clamp(std::ceil(box.bottom), height);
  // What is found in the right image at the left of the box is part of the search; the matcher leaves out that margin.
  const int levels = 16 * std::max(1, static_cast<int>(std::ceil(max_disparity * scale_x / 16)));
  const int margin = std::min(left, static_cast<int>(std::ceil(levels / scale_x)));
  if (right - left < 2 || bottom - top < 2) return {};
  const cv::Rect part(left - margin, top, right - left + margin, bottom - top);
  const cv::Mat left_part = Scaled(images.left(part), scale_x, scale_y);
  const cv::Mat right_part = Scaled(images.right(part), scale_x, scale_y);
  if (left_part.cols <= levels + kBlock || left_part.rows < kBlock) return {};

  const auto matcher = cv::StereoSGBM::create(0, levels, kBlock, 8 * kBlock * kBlock, 32 * kBlock * kBlock, 1, 31, 5, 0,
                                              0, cv::StereoSGBM::MODE_SGBM);
  cv::Mat sixteenths;
  matcher->compute(left_part, right_part, sixteenths);
  DisparityPatch patch;
  patch.step_x = static_cast<double>(part.width) / left_part.cols;
  patch.step_y = static_cast<double>(part.height) / left_part.rows;
  const int skip = static_cast<int>(std::round(margin / patch.step_x));
  patch.x0 = part.x + (skip + 0.5) * patch.step_x - 0.5;  // resize() keeps the corners of the image, not its pixels
  patch.y0 = part.y + 0.5 * patch.step_y - 0.5;
  sixteenths.colRange(skip, sixteenths.cols).convertTo(patch.values, CV_32F, patch.step_x / 16);
  patch.values.setTo(std::numeric_limits<float>::quiet_NaN(), patch.values <= 0);
  return patch;
}

}  // namespace sslcd
