// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sslcd {

using TensorShape = std::vector<std::int64_t>;

/// What goes into a model and comes out of it: numbers in C order, the last index running fastest.
struct Tensor {
  TensorShape shape;
  std::vector<float> values;  ///< as many as ElementCount(shape)
};

/// Product of the dimensions; 1 for a scalar. All must be known (>= 0).
std::size_t ElementCount(const TensorShape& shape);

/// "1x3x352x352"; a dimension that is not fixed (-1) is "?".
std::string ToString(const TensorShape& shape);

/// Same number of dimensions, and equal wherever both are known (>= 0).
bool Fits(const TensorShape& shape, const TensorShape& expected);

}  // namespace sslcd
