// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "render/stage_set.h"

namespace sslcd::render {

/// How much of the sky the ground sees beside and below vehicles. An estimate from the distance to
/// their footprints; rays would be exact, and either slow or noisy.
class ContactShade {
 public:
  ContactShade(const StageSet& set, const std::vector<StageSet::Thing>& things);
  float OpenSky(const Vec3f& place) const;  ///< 0 to 1; 1 away from the ground

 private:
  struct Footprint {
    Vec2f centre, ahead;
    Vec2f half;  ///< length, width
  };
  std::vector<Footprint> footprints_;
  NearList near_;
};

}  // namespace sslcd::render
