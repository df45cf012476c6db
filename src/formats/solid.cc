// SPDX-License-Identifier: BSD-3-Clause
#include "formats/solid.h"

#include <cmath>

namespace sslcd {

Solid UnitBox() {
  Solid box;
  // Corner i: bit 0 front, bit 1 left, bit 2 top.
  for (int i = 0; i < 8; ++i)
    box.corners.emplace_back(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
  box.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return box;
}

Solid UnitCylinder() {
  constexpr int kSides = 14;
  Solid cylinder;
  std::vector<int> bottom, top;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * M_PI * i / kSides;
    for (const double z : {-.5, .5})
      cylinder.corners.emplace_back(.5 * std::cos(angle), .5 * std::sin(angle), z);
    const int here = 2 * i, next = 2 * ((i + 1) % kSides);
    cylinder.faces.push_back({here, next, next + 1, here + 1});
    bottom.insert(bottom.begin(), here);
    top.push_back(here + 1);
  }
  cylinder.faces.push_back(bottom);
  cylinder.faces.push_back(top);
  return cylinder;
}

}  // namespace sslcd
