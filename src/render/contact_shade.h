// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "render/stage_set.h"

namespace sslcd::render {

/// Estimates the share of the sky that the ground sees beside and below vehicles, from the distance
/// to their footprints. Ray casting would be exact, but slow or noisy.
class ContactShade {
 public:
  ContactShade(const StageSet& set, const std::vector<StageSet::Thing>& things);
  float OpenSky(const Vec3f& place) const;  ///< 0 to 1; 1 above the ground

 private:
  struct Footprint {
    Vec2f centre, ahead;
    Vec2f half;  ///< length, width
  };
  std::vector<Footprint> footprints_;
  NearList near_;
};

}  // namespace sslcd::render
