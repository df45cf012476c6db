// SPDX-License-Identifier: BSD-3-Clause
#include "loop/correlate.h"

#include <algorithm>
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

// One part of the sum: four rows of `Lanes` bytes, which the compiler keeps in registers. Returns
// whether one of the bytes exceeds the threshold.
template <class Lanes>
inline __attribute__((always_inline)) bool AddRows(const ShiftedRasters& rasters,
                                                   std::ptrdiff_t offset, std::uint8_t threshold,
                                                   std::uint8_t* sums, int sum_stride) {
  constexpr std::size_t kBytes = sizeof(Lanes);
  Lanes a{}, b{}, c{}, d{};
  const std::ptrdiff_t stride = rasters.stride;
  for (int k = 0; k < rasters.count; ++k) {
    const std::uint8_t* const from = rasters.cells[k] + offset;
    AddRow(from, a);
    AddRow(from + stride, b);
    AddRow(from + 2 * stride, c);
    AddRow(from + 3 * stride, d);
  }
  std::memcpy(sums, &a, kBytes);
  std::memcpy(sums + sum_stride, &b, kBytes);
  std::memcpy(sums + 2 * sum_stride, &c, kBytes);
  std::memcpy(sums + 3 * sum_stride, &d, kBytes);
  const Lanes high = (a > threshold) | (b > threshold) | (c > threshold) | (d > threshold);
  std::uint64_t words[kBytes / sizeof(std::uint64_t)], any = 0;
  std::memcpy(words, &high, kBytes);
  for (const std::uint64_t word : words) any |= word;
  return any != 0;
}

using Lanes16 = std::uint8_t __attribute__((vector_size(16)));

bool AddPart(const ShiftedRasters& rasters, std::ptrdiff_t offset, std::uint8_t threshold,
             std::uint8_t* sums, int sum_stride) {
  const bool left = AddRows<Lanes16>(rasters, offset, threshold, sums, sum_stride);
  return AddRows<Lanes16>(rasters, offset + 16, threshold, sums + 16, sum_stride) || left;
}

using AddPartFunction = decltype(&AddPart);

#if defined(__x86_64__)
using Lanes32 = std::uint8_t __attribute__((vector_size(32)));

__attribute__((target("avx2"))) bool AddPartAvx2(const ShiftedRasters& rasters,
                                                 std::ptrdiff_t offset, std::uint8_t threshold,
                                                 std::uint8_t* sums, int sum_stride) {
  return AddRows<Lanes32>(rasters, offset, threshold, sums, sum_stride);
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

void Correlation::Add(const ShiftedRasters& rasters, std::uint8_t threshold) {
  static const AddPartFunction add_part = Fastest();
  constexpr int kBlocks = kSide / kBlock;
  static_assert(kBlocks == sizeof(Lanes16), "one row of bounds");
  constexpr int kPerChunk = kChunk / kBlock;
  threshold_ = threshold;
  part_count_ = 0;
  for (int row = 0; row < kBlocks; ++row) {
    Lanes16 sum{};
    for (int k = 0; k < rasters.count; ++k) {
      Lanes16 add;
      std::memcpy(&add, rasters.bounds[k] + row * rasters.bound_stride, kBlocks);
      sum += add;
    }
    std::array<std::uint8_t, kBlocks> bound;
    std::memcpy(bound.data(), &sum, kBlocks);
    for (int x = 0; x < kSide; x += kChunk) {
      const auto first = bound.begin() + x / kBlock;
      std::uint8_t* const sums = &sums_[At(x, kBlock * row)];
      if (*std::max_element(first, first + kPerChunk) <= threshold) {
        for (int i = 0; i < kBlock; ++i) std::memset(sums + i * kStride, 0, kChunk);
        continue;
      }
      if (add_part(rasters, kBlock * row * rasters.stride + x, threshold, sums, kStride))
        parts_[part_count_++] = {x, kBlock * row};
    }
  }
}

}  // namespace sslcd
