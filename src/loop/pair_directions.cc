// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pair_directions.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sslcd::pair_directions {
namespace {

// Smallest excess of a peak over the mean, in standard deviations. Set by hand: rows of the right
// place reach 5, without rows few tiles reach 4 (docs/notes, city).
constexpr float kLeastPeak = 4.f;
// Smallest excess of a further peak, share of the highest. Set by hand: streets bend, so that they
// have peaks next to each other.
constexpr float kFurtherPeak = 0.7f;

// Counts of a map, each row twice, so that a turned row is contiguous.
struct TwoTurns {
  std::array<std::uint16_t, 2 * kDistances * kDirections> counts;
  std::uint16_t most = 0;

  explicit TwoTurns(const Counts& map) {
    for (int d = 0; d < kDistances; ++d) {
      const auto row = map.begin() + d * kDirections;
      const auto to = counts.begin() + 2 * d * kDirections;
      std::copy(row, row + kDirections, to);
      std::copy(row, row + kDirections, to + kDirections);
    }
    for (const std::uint16_t count : map) most = std::max(most, count);
  }
  // The row of the bin's distance from the bin's direction on.
  const std::uint16_t* TurnedRow(int bin) const {
    return &counts[static_cast<std::size_t>(bin + bin / kDirections * kDirections)];
  }
};

using Lanes = std::uint16_t __attribute__((vector_size(16)));
constexpr int kLanes = sizeof(Lanes) / sizeof(std::uint16_t);

// One variable per vector: an array would go through the stack.
void AddLanes(const std::uint16_t* from, Lanes& sum) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  sum += lanes;
}

// c(yaw) of the header. The sums have 16 bits as long as they fit.
std::array<int, kDirections> Agreement(const std::vector<int>& local, const Counts& map) {
  constexpr int kStep = 3 * kLanes;
  static_assert(kDirections % kStep == 0, "whole steps");
  const TwoTurns turns(map);
  const std::size_t at_once = 65535 / std::max<std::size_t>(1, turns.most);
  std::array<int, kDirections> agreement{};
  for (std::size_t first = 0; first < local.size(); first += at_once) {
    const std::size_t end = std::min(local.size(), first + at_once);
    for (int i = 0; i < kDirections; i += kStep) {
      Lanes a{}, b{}, c{};
      for (std::size_t k = first; k < end; ++k) {
        const std::uint16_t* const row = turns.TurnedRow(local[k]) + i;
        AddLanes(row, a);
        AddLanes(row + kLanes, b);
        AddLanes(row + 2 * kLanes, c);
      }
      for (int j = 0; j < kLanes; ++j) {
        agreement[i + j] += a[j];
        agreement[i + kLanes + j] += b[j];
        agreement[i + 2 * kLanes + j] += c[j];
      }
    }
  }
  return agreement;
}

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
  const std::array<int, kDirections> agreement = Agreement(local, map);
  std::array<int, kDirections + 2> smooth{};  // with the bins beyond both ends
  int sum = 0;
  for (int i = 0; i < kDirections; ++i) {
    const int before = agreement[(i + kDirections - 1) % kDirections],
              after = agreement[(i + 1) % kDirections];
    smooth[i + 1] = before + 2 * agreement[i] + after;
    sum += smooth[i + 1];
  }
  const float mean = static_cast<float>(sum) / kDirections;
  // of a count that is Poisson distributed about the mean; the smoothed bins have the weights 1, 2,
  // 1
  const float sigma = std::sqrt(1.5f * mean + 1);
  Headings found;
  float highest = 0;
  while (found.count < kMaxHeadings) {
    int most = 0;
    for (int i = 1; i <= kDirections; ++i) most = std::max(most, smooth[i]);
    const float excess = static_cast<float>(most) - mean;
    if (excess < kLeastPeak * sigma || excess < kFurtherPeak * highest) break;
    highest = std::max(highest, excess);
    const auto peak = std::find(smooth.begin() + 1, smooth.end(), most) - smooth.begin();
    found.bin[found.count++] = static_cast<int>(peak) - 1;
    found.bin[found.count++] = static_cast<int>(peak) - 1 + kDirections;
    smooth[peak] = 0;
    smooth[peak == 1 ? kDirections : peak - 1] = 0;
    smooth[peak == kDirections ? 1 : peak + 1] = 0;
  }
  return found;
}

float YawOf(int heading) {
  const float yaw = static_cast<float>(heading % kDirections * kBinRad);
  return heading < kDirections ? yaw : yaw + static_cast<float>(M_PI);
}

}  // namespace sslcd::pair_directions
