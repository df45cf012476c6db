// SPDX-License-Identifier: BSD-3-Clause
#include "loop/correlate.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace sslcd {
namespace {

constexpr int kSide = Correlation::kSide, kBlock = Correlation::kBlock;

// Random rasters with bounds that are exact for each block.
struct Scene {
  static constexpr int kCount = 5, kStride = 96, kBounds = 16;

  explicit Scene(unsigned seed) : random(seed) {
    for (std::uint8_t& cell : cells)
      cell = static_cast<std::uint8_t>(random() % 50 < 49 ? 0 : random() % 51);
    for (int k = 0; k < kCount; ++k) {
      shifts.cells[k] = k * kSide * kStride;
      shifts.bounds[k] = k * kBounds * kBounds;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          std::uint8_t& bound = bounds[shifts.bounds[k] + y / kBlock * kBounds + x / kBlock];
          bound = std::max(bound, cells[shifts.cells[k] + y * kStride + x]);
        }
    }
    shifts.count = kCount;
  }

  Rasters rasters() const { return {cells.data(), bounds.data(), kStride, kBounds}; }

  int Sum(int x, int y) const {
    if (x < 0 || y < 0 || x >= kSide || y >= kSide) return 0;
    int sum = 0;
    for (int k = 0; k < kCount; ++k) sum += cells[shifts.cells[k] + y * kStride + x];
    return sum;
  }

  // Cells above the threshold that are the first of the largest ones around.
  std::map<std::pair<int, int>, int> Peaks(int threshold) const {
    std::map<std::pair<int, int>, int> peaks;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const int sum = Sum(x, y);
        bool peak = sum > threshold;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const bool earlier = dy < 0 || (dy == 0 && dx < 0);
            if (dx != 0 || dy != 0)
              peak &= earlier ? Sum(x + dx, y + dy) < sum : Sum(x + dx, y + dy) <= sum;
          }
        if (peak) peaks[{x, y}] = sum;
      }
    return peaks;
  }

  std::mt19937 random;
  std::vector<std::uint8_t> cells = std::vector<std::uint8_t>(kCount * kSide * kStride);
  std::vector<std::uint8_t> bounds = std::vector<std::uint8_t>(kCount * kBounds * kBounds);
  RasterShifts shifts;
};

TEST(Correlation, FindsThePeaksOfTheSum) {
  Correlation correlation;  // used again: nothing of the last sum remains
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Scene scene(seed);
    for (const int threshold : {0, 40, 70, 200}) {
      std::map<std::pair<int, int>, int> found;
      correlation.Add(scene.rasters(), scene.shifts, static_cast<std::uint8_t>(threshold));
      correlation.VisitPeaks([&](int x, int y, int sum) { found[{x, y}] = sum; });
      // A part is skipped where no block can exceed the threshold, so that only neighbours below
      // it are missing.
      EXPECT_EQ(found, scene.Peaks(threshold)) << "seed " << seed << ", above " << threshold;
    }
  }
}

TEST(Correlation, SkipsWhatTheBoundExcludes) {
  Scene scene(1);
  std::fill(scene.bounds.begin(), scene.bounds.end(), 8);
  Correlation correlation;
  correlation.Add(scene.rasters(), scene.shifts, 8 * Scene::kCount);
  correlation.VisitPeaks([](int, int, int) { ADD_FAILURE() << "not skipped"; });
  correlation.Add(scene.rasters(), scene.shifts, 8 * Scene::kCount - 1);
  int peaks = 0;
  correlation.VisitPeaks([&](int, int, int) { ++peaks; });
  EXPECT_GT(peaks, 0);
}

TEST(Correlation, NoRasterNoPeak) {
  Correlation correlation;
  correlation.Add(Scene(1).rasters(), {}, 0);
  correlation.VisitPeaks([](int, int, int) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace sslcd
