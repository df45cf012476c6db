// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "render/scene_model.h"

namespace sslcd::render {

/// Estimates the share of the sky that the ground sees beside and below vehicles, from the distance
/// to their footprints. Ray casting would be exact, but slow or noisy.
class ContactShadow {
 public:
  ContactShadow(const SceneModel& model, const std::vector<SceneModel::SceneObject>& objects);
  float VisibleSky(const Vec3f& place) const;  ///< 0 to 1; 1 above the ground

 private:
  struct Footprint {
    Vec2f centre, ahead;
    Vec2f half;  ///< length, width
  };
  std::vector<Footprint> footprints_;
  GridIndex near_;
};

}  // namespace sslcd::render
