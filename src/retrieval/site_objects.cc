// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/error.h"
#include "sslcd/retrieval/site_index.h"

namespace sslcd {

std::vector<SiteObject> SiteObjectsOf(const ReferenceMap& map) {
  std::vector<SiteObject> objects;
  for (const LayoutObject& object : map.objects) {
    if (object.label < 0 || object.label >= static_cast<int>(map.label_names.size()))
      throw Error(ErrorKind::kBadInput, "the map has no name for the label of object " +
                                            std::to_string(object.id) +
                                            "; add it to ReferenceMap::label_names");
    objects.push_back({map.label_names[object.label], object.position.x(), object.position.y()});
  }
  return objects;
}

std::vector<SiteObject> SiteObjectsOf(const std::vector<MapObject>& landmarks,
                                      const GravityFrame& gravity) {
  std::vector<SiteObject> objects;
  for (const MapObject& landmark : landmarks) {
    if (landmark.state != LandmarkState::kConfirmed) continue;
    const Vec3 centre = landmark.T_world_object.translation();
    objects.push_back({landmark.label, gravity.forward.dot(centre), gravity.left.dot(centre)});
  }
  return objects;
}

}  // namespace sslcd
