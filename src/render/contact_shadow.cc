// SPDX-License-Identifier: BSD-3-Clause
// All sizes [m], colours (linear red, green, blue) and frequencies [1/m] of this file were set by
// hand.
#include "render/contact_shadow.h"

namespace sslcd::render {

ContactShadow::ContactShadow(const SceneModel& model,
                             const std::vector<SceneModel::SceneObject>& objects)
    : near_(model.used().low - Vec2f::Constant(5), model.used().high + Vec2f::Constant(5), 4) {
  constexpr float kReach = 1.2f;
  for (const SceneModel::SceneObject& object : objects) {
    if (object.identity < 0 || object.kind == SceneModel::Kind::kPole) continue;
    const Eigen::Matrix3f axes = object.instance.T_world_mesh.so3().matrix().cast<float>();
    const Vec3f at = object.instance.T_world_mesh.translation().cast<float>();
    const Vec3f dims = model.world().objects[object.identity].dims.cast<float>();
    Footprint footprint{at.head<2>(), axes.col(0).head<2>(), 0.5f * dims.head<2>()};
    if (object.kind == SceneModel::Kind::kTree) footprint.half *= 0.5f;
    const Vec2f reach = Vec2f::Constant(footprint.half.norm() + kReach);
    near_.Add(footprint.centre - reach, footprint.centre + reach,
              static_cast<int>(footprints_.size()));
    footprints_.push_back(footprint);
  }
}

float ContactShadow::VisibleSky(const Vec3f& place) const {
  if (place.z() > 0.05f) return 1;
  float open = 1;
  for (int i : near_.At(place.head<2>())) {
    const Footprint& footprint = footprints_[i];
    const Vec2f off = place.head<2>() - footprint.centre;
    const Vec2f own(std::abs(off.dot(footprint.ahead)),
                    std::abs(off.x() * footprint.ahead.y() - off.y() * footprint.ahead.x()));
    const Vec2f out = own - footprint.half;
    const float inside = -std::max(out.x(), out.y());
    const float outside = out.cwiseMax(Vec2f::Zero()).norm();
    open *=
        inside > 0 ? 0.4f - 0.32f * Clamp01(inside / 0.5f) : 1 - 0.6f * std::exp(-outside / 0.32f);
  }
  return open;
}

}  // namespace sslcd::render
