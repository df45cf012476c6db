// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "sslcd/retrieval/site_index.h"

namespace sslcd {

/// Objects of two labels by chance on a square of this side. [m]
inline Site RandomSite(const std::string& name, unsigned seed, int objects, double side = 150) {
  std::mt19937 engine(seed);
  const auto uniform = [&] { return static_cast<double>(engine()) / 4294967296.; };
  Site site{name, {}};
  for (int i = 0; i < objects; ++i)
    site.objects.push_back({i % 3 == 0 ? "Pole" : "Car", side * uniform(), side * uniform()});
  return site;
}

/// The objects in a box of a site, turned by `yaw` and moved, each off by up to `noise_m`.
inline std::vector<SiteObject> StretchOfSite(const Site& site, double yaw, double noise_m,
                                             bool mirrored = false) {
  std::mt19937 engine(5);
  const auto noise = [&] { return noise_m * (static_cast<double>(engine()) / 2147483648. - 1); };
  std::vector<SiteObject> stretch;
  for (const SiteObject& object : site.objects) {
    if (object.x > 90 || object.y < 20 || object.y > 60) continue;
    const double x = object.x - 40, y = (mirrored ? -1 : 1) * (object.y - 40);
    stretch.push_back({object.label, std::cos(yaw) * x - std::sin(yaw) * y + 7 + noise(),
                       std::sin(yaw) * x + std::cos(yaw) * y - 3 + noise()});
  }
  return stretch;
}

}  // namespace sslcd
