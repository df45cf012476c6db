// SPDX-License-Identifier: BSD-3-Clause
#include "loop/correlate.h"

#include <cstring>

namespace sslcd {
namespace {

constexpr int kRows = Correlation::kBlock;
static_assert(kRows == 4, "AddRows has four sums");

// Adds bytes from any address. One variable per row: an array of rows would go through the stack,
// which costs five times as much.
template <class Lanes>
inline __attribute__((always_inline)) void AddRow(const std::uint8_t* from, Lanes& sum) {
  Lanes row;
  std::memcpy(&row, from, sizeof row);
  sum += row;
}

// Whether a byte of a mask is set.
template <class Lanes>
inline __attribute__((always_inline)) bool AnyOf(const Lanes& mask) {
  std::uint64_t words[sizeof(Lanes) / sizeof(std::uint64_t)], any = 0;
  std::memcpy(words, &mask, sizeof mask);
  for (const std::uint64_t word : words) any |= word;
  return any != 0;
}

// One part of the sum: four rows of `Lanes` bytes, which the compiler keeps in registers. Returns
// whether one of the bytes exceeds the threshold.
template <class Lanes>
inline __attribute__((always_inline)) bool AddRows(const std::uint8_t* cells, std::ptrdiff_t stride,
                                                   const RasterShifts& shifts,
                                                   std::uint8_t threshold, std::uint8_t* sums) {
  constexpr int sum_stride = Correlation::kStride;
  constexpr std::size_t kBytes = sizeof(Lanes);
  Lanes a{}, b{}, c{}, d{};
  for (int k = 0; k < shifts.count; ++k) {
    const std::uint8_t* const from = cells + shifts.cells[k];
    AddRow(from, a);
    AddRow(from + stride, b);
    AddRow(from + 2 * stride, c);
    AddRow(from + 3 * stride, d);
  }
  std::memcpy(sums, &a, kBytes);
  std::memcpy(sums + sum_stride, &b, kBytes);
  std::memcpy(sums + 2 * sum_stride, &c, kBytes);
  std::memcpy(sums + 3 * sum_stride, &d, kBytes);
  return AnyOf((a > threshold) | (b > threshold) | (c > threshold) | (d > threshold));
}

using Lanes16 = std::uint8_t __attribute__((vector_size(16)));

bool AddPart(const std::uint8_t* cells, std::ptrdiff_t stride, const RasterShifts& shifts,
             std::uint8_t threshold, std::uint8_t* sums) {
  const bool left = AddRows<Lanes16>(cells, stride, shifts, threshold, sums);
  return AddRows<Lanes16>(cells + 16, stride, shifts, threshold, sums + 16) || left;
}

using AddPartFunction = decltype(&AddPart);

#if defined(__x86_64__)
using Lanes32 = std::uint8_t __attribute__((vector_size(32)));

__attribute__((target("avx2"))) bool AddPartAvx2(const std::uint8_t* cells, std::ptrdiff_t stride,
                                                 const RasterShifts& shifts, std::uint8_t threshold,
                                                 std::uint8_t* sums) {
  return AddRows<Lanes32>(cells, stride, shifts, threshold, sums);
}

AddPartFunction Fastest() { return __builtin_cpu_supports("avx2") ? AddPartAvx2 : AddPart; }
#else
AddPartFunction Fastest() { return AddPart; }
#endif

}  // namespace

bool Correlation::IsPeak(int x, int y) const {
  const std::uint8_t sum = Sum(x, y);
  for (int dx = -1; dx <= 1; ++dx)
    if (Sum(x + dx, y - 1) >= sum || Sum(x + dx, y + 1) > sum) return false;
  return Sum(x - 1, y) < sum && Sum(x + 1, y) <= sum;
}

void Correlation::Add(const Rasters& rasters, const RasterShifts& shifts, std::uint8_t threshold) {
  static const AddPartFunction add_part = Fastest();
  constexpr int kBlocks = kSide / kBlock, kChunks = kSide / kChunk;
  static_assert(kBlocks == sizeof(Lanes16), "one row of bounds");
  static_assert(kBlocks / kChunks == sizeof(std::uint64_t), "a word of bounds for each chunk");
  threshold_ = threshold;
  part_count_ = 0;
  for (int row = 0; row < kBlocks; ++row) {
    const std::uint8_t* const bounds = rasters.bounds + row * rasters.bound_stride;
    Lanes16 sum{};
    for (int k = 0; k < shifts.count; ++k) AddRow(bounds + shifts.bounds[k], sum);
    const Lanes16 above = sum > threshold;
    std::uint64_t words[kChunks];
    std::memcpy(words, &above, sizeof above);
    for (int chunk = 0; chunk < kChunks; ++chunk) {
      const int x = chunk * kChunk, y = row * kBlock;
      std::uint8_t* const sums = &sums_[At(x, y)];
      if (words[chunk] == 0) {
        for (int i = 0; i < kBlock; ++i) std::memset(sums + i * kStride, 0, kChunk);
        continue;
      }
      const std::uint8_t* const cells =
          rasters.cells + static_cast<std::ptrdiff_t>(y) * rasters.stride + x;
      if (add_part(cells, rasters.stride, shifts, threshold, sums)) parts_[part_count_++] = {x, y};
    }
  }
}

}  // namespace sslcd
