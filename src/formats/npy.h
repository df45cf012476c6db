// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/export.h"

namespace sslcd {

/// A matrix of a NumPy file, stored row by row.
struct NpyMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<float> values;  ///< rows * columns

  const float* Row(std::size_t row) const { return values.data() + row * columns; }
};

/// Reads a two-dimensional little-endian float32 or float64 array in C order, format version 1
/// to 3. Throws Error for any other array and says how to save it.
SSLCD_EXPORT NpyMatrix ReadNpy(const std::string& path);

/// Returns the bytes of a float32 .npy file, format version 1.
std::string NpyBytes(const NpyMatrix& matrix);

}  // namespace sslcd
