// SPDX-License-Identifier: BSD-3-Clause
#include "visual_odometry/corners.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sslcd {
namespace {

// Smallest eigenvalue of a corner, relative to that of the strongest corner: OpenCV's usual value.
constexpr double kMinCorner = 0.01;

/// Moves corners to the centre of the gradients of their patches (Foerstner and Guelch, 1987).
/// There the patch moves like its corner even if its scale or slant changes. Elsewhere a change of
/// scale adds a shift, mostly in the direction of motion, which shortens the estimated path.
void CentrePatches(const cv::Mat& grey, std::vector<cv::Point2f>& corners, int patch_px) {
  const int half = patch_px / 2, least = 2 * half + 5;  // smallest side that OpenCV accepts
  if (corners.empty() || grey.cols < least || grey.rows < least) return;
  constexpr int kMaxSteps = 20;     // set by hand
  constexpr double kDonePx = 0.01;  // set by hand
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kMaxSteps, kDonePx);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1}, until);
}

}  // namespace

std::vector<cv::Point2f> SpreadCorners(const StereoPyramids& images,
                                       const std::vector<cv::Point2f>& taken, int cells,
                                       int patch_px) {
  constexpr int kBlockPx = 5, kMinCellPx = 8;  // set by hand
  cv::Mat strength;
  cv::cornerMinEigenVal(images.left[0], strength, kBlockPx);
  double strongest = 0;
  cv::minMaxLoc(strength, nullptr, &strongest);
  const int cell =
      std::max(kMinCellPx, static_cast<int>(std::sqrt(images.size.area() / double(cells))));
  const int columns = (images.size.width + cell - 1) / cell,
            rows = (images.size.height + cell - 1) / cell;
  std::vector<bool> occupied(static_cast<std::size_t>(columns) * rows);
  for (const cv::Point2f& p : taken)
    occupied[static_cast<int>(p.y) / cell * columns + static_cast<int>(p.x) / cell] = true;

  std::vector<cv::Point2f> corners;
  const int margin = patch_px / 2 + 2;  // keeps the whole patch in the image
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
  // A centre may move into the next cell, onto an existing point.
  constexpr float kApart = 2;  // [px] set by hand
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
