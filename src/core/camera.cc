// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/camera.h"

#include <algorithm>

namespace sslcd {

double Iou(const Box2d& a, const Box2d& b) {
  const Box2d both{std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
                   std::min(a.bottom, b.bottom)};
  const double intersection = both.Area();
  return intersection > 0 ? intersection / (a.Area() + b.Area() - intersection) : 0.;
}

}  // namespace sslcd
