// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>

#include "sslcd/core/layout.h"

namespace sslcd {

/// Whether an object has a heading: it is known, and the object is not round.
bool HasHeading(const LayoutObject& object);

/// Frequencies of the labels and headings of a map.
struct LayoutCounts {
  /// Number of objects by heading, in bins of one degree from 0; [0]: objects without symmetry,
  /// [1]: objects with kPi.
  using Headings = std::array<std::array<int, 360>, 2>;

  std::map<int, int> labels;  ///< number of objects by label; labels without objects are left out
  Headings headings{};

  /// Counts an object `by` times more; -1: it is removed or changes.
  void Count(const LayoutObject& object, int by);
};

}  // namespace sslcd
