// SPDX-License-Identifier: BSD-3-Clause
#include "visual_odometry/row_error.h"

#include <array>
#include <cmath>

#include "core/median.h"
#include "stereo/geometry.h"
#include "stereo/image_pyramids.h"
#include "visual_odometry/corners.h"
#include "visual_odometry/odometry_follow.h"

namespace sslcd {

std::optional<double> RowError(const StereoCamera& camera, const std::vector<StereoView>& pairs,
                               const StereoOdometryOptions& options) {
  // Cells of the image, cells that need points, and points that a cell needs. Set by hand.
  constexpr int kColumns = 6, kRows = 4, kLeastCells = 12;
  constexpr std::size_t kLeastPoints = 20;
  std::array<std::vector<float>, kColumns * kRows> cells;
  for (const StereoView& pair : pairs) {
    CheckImages(pair);
    const StereoPyramids images = BuildPyramids(pair, kPatchPx);
    const std::vector<cv::Point2f> left = SpreadCorners(images, {}, options.points, kPatchPx);
    const TrackedPoints right =
        TrackForthAndBack(images.left, images.right, left, left, kCoarse, kPatchPx);
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (!right.found[i] || !IsPair(camera, left[i], right.at[i])) continue;
      const int column =
          static_cast<int>(kColumns * left[i].x / static_cast<float>(images.size.width));
      const int row = static_cast<int>(kRows * left[i].y / static_cast<float>(images.size.height));
      cells[row * kColumns + column].push_back(right.at[i].y - left[i].y);
    }
  }
  double squares = 0;
  int count = 0;
  for (const std::vector<float>& cell : cells) {
    if (cell.size() < kLeastPoints) continue;
    squares += std::pow(Median(cell), 2);
    ++count;
  }
  if (count < kLeastCells) return std::nullopt;
  return std::sqrt(squares / count);
}

}  // namespace sslcd
