// SPDX-License-Identifier: BSD-3-Clause
#include "loop/layout_counts.h"

#include <cmath>

namespace sslcd {

bool HasHeading(const LayoutObject& object) {
  return object.symmetry != Symmetry::kFull && std::isfinite(object.yaw);
}

void LayoutCounts::Count(const LayoutObject& object, int by) {
  const auto label = labels.insert({object.label, 0}).first;
  if ((label->second += by) == 0) labels.erase(label);
  if (!HasHeading(object)) return;
  const int degree =
      static_cast<int>(std::floor((WrapAngle(object.yaw) / (2 * M_PI) + 1) * 360 + 0.5)) % 360;
  headings[object.symmetry == Symmetry::kPi][degree] += by;
}

}  // namespace sslcd
