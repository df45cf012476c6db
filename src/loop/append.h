// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace sslcd {

/// Appends a default value. The capacity grows by an eighth, not by a factor of two: for the lists
/// of large maps, whose unused memory would count.
template <class T>
T& Append(std::vector<T>& values) {
  if (values.size() == values.capacity()) values.reserve(values.size() + values.size() / 8 + 16);
  return values.emplace_back();
}

}  // namespace sslcd
