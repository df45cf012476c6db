// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sslcd {

using TensorShape = std::vector<std::int64_t>;

/// An input or output of a model: numbers in C order, the last index running fastest.
struct Tensor {
  TensorShape shape;
  std::vector<float> values;  ///< ElementCount(shape) values
};

/// Product of the dimensions; 1 for a scalar. All must be known (>= 0).
std::size_t ElementCount(const TensorShape& shape);

/// The shape as text, e.g. "1x3x352x352". A dimension that is not fixed (-1) is "?".
std::string ToString(const TensorShape& shape);

/// Whether the shapes have the same number of dimensions and agree in all that both fix (>= 0).
bool Fits(const TensorShape& shape, const TensorShape& expected);

}  // namespace sslcd
