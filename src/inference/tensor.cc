// SPDX-License-Identifier: BSD-3-Clause
#include "inference/tensor.h"

#include <cassert>

namespace sslcd {

std::size_t ElementCount(const TensorShape& shape) {
  std::size_t count = 1;
  for (const std::int64_t size : shape) {
    assert(size >= 0);
    count *= static_cast<std::size_t>(size);
  }
  return count;
}

std::string ToString(const TensorShape& shape) {
  std::string text;
  for (const std::int64_t size : shape)
    text += (text.empty() ? "" : "x") + (size < 0 ? "?" : std::to_string(size));
  return text.empty() ? "scalar" : text;
}

bool Fits(const TensorShape& shape, const TensorShape& expected) {
  if (shape.size() != expected.size()) return false;
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (shape[i] >= 0 && expected[i] >= 0 && shape[i] != expected[i]) return false;
  return true;
}

}  // namespace sslcd
