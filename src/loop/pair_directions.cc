// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pair_directions.h"

#include <algorithm>
#include <cmath>

namespace sslcd::pair_directions {
namespace {

// Smallest excess of a peak over the mean, in standard deviations. Set by hand: rows of the right
// place reach 5, without rows few tiles reach 4 (docs/notes, city).
constexpr float kLeastPeak = 4.f;
// Smallest excess of a further peak, share of the highest. Set by hand: streets bend, so that they
// have peaks next to each other.
constexpr float kFurtherPeak = 0.7f;

}  // namespace

int Bin(float dx, float dy) {
  const float d2 = dx * dx + dy * dy;
  if (!(d2 >= kNearest * kNearest && d2 < kFarthest * kFarthest)) return -1;
  if (dy < 0 || (dy == 0 && dx < 0)) {
    dx = -dx;
    dy = -dy;
  }
  constexpr float kPerRadian = static_cast<float>(1 / kBinRad);
  const int direction = static_cast<int>(std::atan2(dy, dx) * kPerRadian + 0.5f) % kDirections;
  const int distance = std::min(kDistances - 1, static_cast<int>(std::sqrt(d2) / kDistanceBin));
  return distance * kDirections + direction;
}

std::vector<int> BinsOf(const std::vector<LayoutPoint>& points) {
  std::vector<int> bins;
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const int bin = Bin(points[a].x - points[b].x, points[a].y - points[b].y);
      if (bin >= 0) bins.push_back(bin);
    }
  return bins;
}

Headings FindHeadings(const std::vector<int>& local, const Counts& map) {
  // c(yaw) over two half turns, so that the sum needs no modulo
  std::array<std::uint32_t, 2 * kDirections> sum{};
  for (const int bin : local) {
    const int direction = bin % kDirections;
    const std::uint16_t* const row = &map[static_cast<std::size_t>(bin - direction)];
    std::uint32_t* const at = &sum[static_cast<std::size_t>(kDirections - direction)];
    for (int i = 0; i < kDirections; ++i) at[i] += row[i];
  }
  std::array<float, kDirections + 2> raw{}, smooth{};  // with the bins beyond both ends
  for (int i = 0; i < kDirections; ++i)
    raw[i + 1] = static_cast<float>(sum[i] + sum[i + kDirections]);
  raw[0] = raw[kDirections];
  raw[kDirections + 1] = raw[1];
  for (int i = 1; i <= kDirections; ++i) smooth[i] = raw[i - 1] + 2 * raw[i] + raw[i + 1];
  Headings found;
  float highest = 0, mean = 0;
  for (int i = 1; i <= kDirections; ++i) mean += smooth[i] / kDirections;
  // of a count that is Poisson distributed about the mean; the smoothed bins have the weights 1, 2,
  // 1
  const float sigma = std::sqrt(1.5f * mean + 1);
  while (found.count < kMaxHeadings) {
    const auto peak = std::max_element(smooth.begin() + 1, smooth.end() - 1) - smooth.begin();
    const float excess = smooth[peak] - mean;
    if (excess < kLeastPeak * sigma || excess < kFurtherPeak * highest) break;
    highest = std::max(highest, excess);
    const float yaw = static_cast<float>(static_cast<double>(peak - 1) * kBinRad);
    found.yaw_rad[found.count++] = yaw;
    found.yaw_rad[found.count++] = yaw + static_cast<float>(M_PI);
    smooth[peak] = 0;
    smooth[peak == 1 ? kDirections : peak - 1] = 0;
    smooth[peak == kDirections ? 1 : peak + 1] = 0;
  }
  return found;
}

}  // namespace sslcd::pair_directions
