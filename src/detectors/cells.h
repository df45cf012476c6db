// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <initializer_list>

namespace sslcd {

/// Sides of the cells of YOLOX's three grids [px], in the order of its rows.
constexpr std::initializer_list<int> kYoloxStrides = {8, 16, 32};

/// The number of cells of `stride_px` that cover an input's side.
constexpr int Cells(int size_px, int stride_px) { return (size_px + stride_px - 1) / stride_px; }

/// The number of cells of all grids over an input.
inline std::int64_t CellCount(int width_px, int height_px, std::initializer_list<int> strides) {
  std::int64_t count = 0;
  for (const int stride : strides)
    count += std::int64_t{1} * Cells(width_px, stride) * Cells(height_px, stride);
  return count;
}

}  // namespace sslcd
