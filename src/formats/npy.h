// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd {

/// A matrix from a NumPy file, row by row.
struct NpyMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<float> values;  ///< rows * columns

  const float* Row(std::size_t row) const { return values.data() + row * columns; }
};

/// Reads a two-dimensional little-endian float32 or float64 array in C order, format version 1
/// to 3. Throws Error saying what was found and how to save it otherwise.
NpyMatrix ReadNpy(const std::string& path);

/// The bytes of a float32 file of the same kind.
std::string NpyBytes(const NpyMatrix& matrix);

}  // namespace sslcd
