// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/disparity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "stereo/grey.h"

namespace sslcd {
namespace {

// Parameters of OpenCV's semi-global matching. The penalties of a change of the disparity by one
// and by more are those of OpenCV's documentation; the others were set by hand.
constexpr int kBlock = 5;  // [px]
constexpr int kSmallPenalty = 8 * kBlock * kBlock, kLargePenalty = 32 * kBlock * kBlock;
constexpr int kMaxLeftRightPx = 1, kPrefilterCap = 31, kUniquenessPercent = 5;
constexpr int kLevelsStep = 16;        // the number of disparities must be a multiple of it
constexpr double kUnitsPerPixel = 16;  // of the matcher's disparities

cv::Mat Scaled(const cv::Mat& image, double scale_x, double scale_y) {
  // the matcher reads beyond the edges of a submatrix
  if (scale_x == 1 && scale_y == 1) return image.clone();
  cv::Mat scaled;
  const bool smaller = scale_x < 1;
  cv::resize(image, scaled, {}, scale_x, scale_y, smaller ? cv::INTER_AREA : cv::INTER_CUBIC);
  return scaled;
}

/// Interpolates in a row by Catmull and Rom's cubic; linear interpolation would pull to whole
/// pixels.
float Between(const float* row, int columns, float x) {
  const int at = static_cast<int>(std::floor(x));
  const auto value = [&](int column) { return row[std::clamp(column, 0, columns - 1)]; };
  const float t = x - static_cast<float>(at), a = value(at - 1), b = value(at), c = value(at + 1),
              d = value(at + 2);
  return b + 0.5F * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// Refines disparities by steps of Lucas and Kanade (IJCAI 1981), because semi-global matching
/// pulls them to whole pixels by up to a fifth of a pixel: one metre at 20 m with a baseline of 12
/// cm. Compares windows without their means, each pixel with its own disparity. The images are
/// blurred, since details below a pixel would also pull to whole pixels. Drops disparities without
/// texture, which the matcher has guessed. `step` is the number of pixels of the whole image per
/// pixel here.
void RefineDisparities(const cv::Mat& left, const cv::Mat& right, double step,
                       cv::Mat& disparities) {
  // Two steps leave an error of 0.03 px (docs/notes, "Cuboids from stereo images"); the others were
  // set by hand.
  constexpr int kSteps = 2, kWindowPx = 9;
  // [px], [grey values per px, squared], both of the whole image
  constexpr double kBlur = 1.2, kFlattest = 2;
  constexpr float kLongest = 0.6F;  // [px] largest step
  const cv::Size window(kWindowPx, kWindowPx);
  const auto blurred = [&](const cv::Mat& image) {
    cv::Mat out;
    image.convertTo(out, CV_32F);
    cv::GaussianBlur(out, out, {}, kBlur / step);
    return out;
  };
  const auto mean = [&](const cv::Mat& values) {
    cv::Mat out;
    cv::boxFilter(values, out, CV_32F, window);
    return out;
  };
  const cv::Mat l = blurred(left), r = blurred(right);
  const auto flattest = static_cast<float>(kFlattest * step * step);
  for (int i = 0; i < kSteps; ++i) {
    cv::Mat error = cv::Mat::zeros(l.size(), CV_32F), slope = error.clone();
    for (int y = 0; y < l.rows; ++y) {
      const float *in_left = l.ptr<float>(y), *in_right = r.ptr<float>(y),
                  *disparity = disparities.ptr<float>(y);
      for (int x = 0; x < l.cols; ++x) {
        if (!(disparity[x] > 0)) continue;
        const auto there = [&](int column) {
          return Between(in_right, l.cols, column - disparity[x]);
        };
        error.at<float>(y, x) = there(x) - in_left[x];
        slope.at<float>(y, x) = 0.5F * (there(x + 1) - there(x - 1));
      }
    }
    const cv::Mat mean_error = mean(error), mean_slope = mean(slope);
    const cv::Mat product = mean(slope.mul(error)) - mean_slope.mul(mean_error);
    const cv::Mat square = mean(slope.mul(slope)) - mean_slope.mul(mean_slope);
    for (int y = 0; y < l.rows; ++y) {
      for (int x = 0; x < l.cols; ++x) {
        const float steepness = square.at<float>(y, x), move = product.at<float>(y, x) / steepness;
        float& disparity = disparities.at<float>(y, x);
        if (!(disparity > 0) || !(steepness > flattest)) {
          disparity = std::numeric_limits<float>::quiet_NaN();
        } else if (std::abs(move) < kLongest) {
          disparity += move;
        }
      }
    }
  }
}

}  // namespace

GreyPair GreyOf(const StereoView& images, const StereoCamera& camera) {
  CheckImages(images);
  return {Grey(images.left), Grey(images.right), camera.disparity_at_infinity};
}

DisparityPatch MatchInside(const GreyPair& images, const Box2d& box, double max_disparity,
                           double scale_x, double scale_y) {
  const int width = images.left.cols, height = images.left.rows;
  const auto clamp = [](double value, int most) {
    return static_cast<int>(std::clamp<double>(value, 0, most));
  };
  const int left = clamp(std::floor(box.left), width), right = clamp(std::ceil(box.right), width);
  const int top = clamp(std::floor(box.top), height), bottom = clamp(std::ceil(box.bottom), height);
  // The search includes the right image left of the box; the matcher leaves out that margin.
  const double most = (max_disparity + images.disparity_at_infinity) * scale_x;
  const int levels = kLevelsStep * std::max(1, static_cast<int>(std::ceil(most / kLevelsStep)));
  const int margin = std::min(left, static_cast<int>(std::ceil(levels / scale_x)));
  if (right - left < 2 || bottom - top < 2) return {};
  const cv::Rect part(left - margin, top, right - left + margin, bottom - top);
  const cv::Mat left_part = Scaled(images.left(part), scale_x, scale_y);
  const cv::Mat right_part = Scaled(images.right(part), scale_x, scale_y);
  if (left_part.cols <= levels + kBlock || left_part.rows < kBlock) return {};

  const auto matcher =
      cv::StereoSGBM::create(0, levels, kBlock, kSmallPenalty, kLargePenalty, kMaxLeftRightPx,
                             kPrefilterCap, kUniquenessPercent, 0, 0, cv::StereoSGBM::MODE_SGBM);
  cv::Mat sixteenths;
  matcher->compute(left_part, right_part, sixteenths);
  DisparityPatch patch;
  patch.step_x = static_cast<double>(part.width) / left_part.cols;
  patch.step_y = static_cast<double>(part.height) / left_part.rows;
  const int skip = static_cast<int>(std::round(margin / patch.step_x));
  // resize() keeps the corners of the image, not its pixels
  patch.x0 = part.x + (skip + 0.5) * patch.step_x - 0.5;
  patch.y0 = part.y + 0.5 * patch.step_y - 0.5;
  cv::Mat disparities;
  sixteenths.convertTo(disparities, CV_32F, 1. / kUnitsPerPixel);
  RefineDisparities(left_part, right_part, patch.step_x, disparities);
  patch.values =
      disparities.colRange(skip, disparities.cols) * patch.step_x - images.disparity_at_infinity;
  patch.values.setTo(std::numeric_limits<float>::quiet_NaN(), ~(patch.values > 0));
  return patch;
}

}  // namespace sslcd
