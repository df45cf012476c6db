// SPDX-License-Identifier: BSD-3-Clause
#include "map_export/geojson.h"

#include "formats/geojson.h"

namespace sslcd {

std::string MapGeoJson(const MapInfo& info, const MapResults& results, const GeoOrigin& origin) {
  std::vector<GeoFeature> features;
  if (results.paths.empty()) return GeoJsonText(features);
  const GeoPlane plane(origin, results.paths[0].trajectory.poses[0], info.up_axis);
  for (const SessionPath& path : results.paths) {
    std::vector<GeoPoint> line;
    for (const Pose& pose : path.trajectory.poses) line.push_back(plane.At(pose.translation()));
    for (const SessionInfo& session : info.sessions)
      if (session.id == path.session)
        features.push_back({GeoFeature::Kind::kLine, line, {{"session", session.name}}});
  }
  for (const MapObject& object : results.objects)
    if (object.state == LandmarkState::kConfirmed)
      features.push_back({GeoFeature::Kind::kPoint,
                          {plane.At(object.T_world_object.translation())},
                          PropertiesOf(object)});
  return GeoJsonText(features);
}

}  // namespace sslcd
