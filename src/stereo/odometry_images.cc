// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/odometry_images.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "stereo/grey.h"

namespace sslcd {
namespace {

constexpr int kMaxLevel = 4;          // sizes from 1 to 1/16
constexpr double kReturnsWithin = 1;  // [px]
// Smallest eigenvalue a patch must have (of OpenCV's, per pixel): what noise alone has.
constexpr double kMinEigenvalue = 1e-4;
// A corner's least share of the strongest corner's smaller eigenvalue: OpenCV's customary value.
constexpr double kMinCorner = 0.01;

constexpr double kMidGrey = 128, kSpread = 40;  // mean and deviation of an evened image
constexpr double kNoise = 4;                    // deviations below are noise, and not blown up

// The image is copied: the host may write into its own while a keyframe still needs it.
ImagePyramid Build(const cv::Mat& grey, int patch_px) {
  ImagePyramid pyramid;
  cv::buildOpticalFlowPyramid(grey, pyramid, {patch_px, patch_px}, kMaxLevel, true,
                              cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
  return pyramid;
}

/// Moves corners to where their patches' gradients have their centre (Foerstner and Guelch, 1987).
/// There a patch that is stretched, because it comes nearer or is slanted, moves as its corner
/// does; elsewhere the stretching adds a shift, mostly towards where the camera goes, and the way
/// seems too short.
void CentrePatches(const cv::Mat& grey, std::vector<cv::Point2f>& corners, int patch_px) {
  const int half = patch_px / 2, least = 2 * half + 5;  // what OpenCV needs
  if (corners.empty() || grey.cols < least || grey.rows < least) return;
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.01);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1}, until);
}

}  // namespace

StereoPyramids BuildPyramids(const StereoView& images, int patch_px) {
  return {Build(Grey(images.left), patch_px), Build(Grey(images.right), patch_px),
          cv::Size(images.left.width, images.left.height)};
}

ImagePyramid Evened(const ImagePyramid& image, int patch_px) {
  const cv::Size surroundings(3 * patch_px, 3 * patch_px);
  cv::Mat grey, mean, square, deviation, evened;
  image[0].convertTo(grey, CV_32F);
  cv::boxFilter(grey, mean, CV_32F, surroundings);
  cv::sqrBoxFilter(grey, square, CV_32F, surroundings);
  cv::sqrt(cv::max(square - mean.mul(mean), 0), deviation);
  cv::Mat(kMidGrey + kSpread * (grey - mean) / (deviation + kNoise)).convertTo(evened, CV_8U);
  return Build(evened, patch_px);
}

Followed Follow(const ImagePyramid& from, const ImagePyramid& to,
                const std::vector<cv::Point2f>& points, const std::vector<cv::Point2f>& guess,
                int levels, int patch_px) {
  Followed result{guess, std::vector<bool>(points.size())};
  if (points.empty()) return result;
  std::vector<unsigned char> status;
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.01);
  cv::calcOpticalFlowPyrLK(from, to, points, result.at, status, cv::noArray(), {patch_px, patch_px},
                           levels, until, cv::OPTFLOW_USE_INITIAL_FLOW, kMinEigenvalue);
  const cv::Rect2f inside(0, 0, static_cast<float>(to[0].cols), static_cast<float>(to[0].rows));
  for (std::size_t i = 0; i < points.size(); ++i)
    result.found[i] = status[i] && inside.contains(result.at[i]);
  return result;
}

Followed FollowThereAndBack(const ImagePyramid& from, const ImagePyramid& to,
                            const std::vector<cv::Point2f>& points,
                            const std::vector<cv::Point2f>& guess, int levels, int patch_px) {
  Followed there = Follow(from, to, points, guess, levels, patch_px);
  std::vector<cv::Point2f> begin = points;
  // Back from a place that is a little off its own guess, or a patch that has not moved would
  // always return.
  for (cv::Point2f& p : begin) p += cv::Point2f(1.5F, 1.5F);
  const Followed back = Follow(to, from, there.at, begin, 0, patch_px);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const cv::Point2f off = back.at[i] - points[i];
    there.found[i] = there.found[i] && back.found[i] && std::hypot(off.x, off.y) <= kReturnsWithin;
  }
  return there;
}

std::vector<cv::Point2f> SpreadCorners(const StereoPyramids& images,
                                       const std::vector<cv::Point2f>& taken, int cells,
                                       int patch_px) {
  cv::Mat strength;
  cv::cornerMinEigenVal(images.left[0], strength, 5);
  double strongest = 0;
  cv::minMaxLoc(strength, nullptr, &strongest);
  const int cell = std::max(8, static_cast<int>(std::sqrt(images.size.area() / double(cells))));
  const int columns = (images.size.width + cell - 1) / cell,
            rows = (images.size.height + cell - 1) / cell;
  std::vector<bool> occupied(static_cast<std::size_t>(columns) * rows);
  for (const cv::Point2f& p : taken)
    occupied[static_cast<int>(p.y) / cell * columns + static_cast<int>(p.x) / cell] = true;

  std::vector<cv::Point2f> corners;
  const int margin = patch_px / 2 + 2;  // or the patch is not in the image as a whole
  const cv::Rect inner(margin, margin, images.size.width - 2 * margin,
                       images.size.height - 2 * margin);
  for (int i = 0; i < columns * rows; ++i) {
    const cv::Rect box = cv::Rect(i % columns * cell, i / columns * cell, cell, cell) & inner;
    if (occupied[i] || box.empty()) continue;
    double best = 0;
    cv::Point at;
    cv::minMaxLoc(strength(box), nullptr, &best, nullptr, &at);
    if (best > kMinCorner * strongest && best > kMinEigenvalue) corners.emplace_back(at + box.tl());
  }
  CentrePatches(images.left[0], corners, patch_px);
  // A centre may lie in the next cell, and be that of a point which is there.
  constexpr float kApart = 2;  // [px]
  std::vector<cv::Point2f> all = taken;
  for (const cv::Point2f& p : corners) {
    const bool known = std::any_of(all.begin(), all.end(), [p](const cv::Point2f& q) {
      return std::hypot(p.x - q.x, p.y - q.y) < kApart;
    });
    if (!known) all.push_back(p);
  }
  return {all.begin() + static_cast<std::ptrdiff_t>(taken.size()), all.end()};
}

}  // namespace sslcd
