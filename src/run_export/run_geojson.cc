// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_geojson.h"

#include <algorithm>
#include <cmath>

#include "formats/geojson.h"
#include "formats/solid.h"

namespace sslcd {
namespace {

using Kind = GeoFeature::Kind;

GeoFeature LineOf(const std::string& name, Colour colour, const std::vector<Vec3>& points,
                  const GeoPlane& plane) {
  GeoFeature line{Kind::kLine, {}, {{"name", name}, {"stroke", Hex(colour)}}};
  for (const Vec3& point : points) line.points.push_back(plane.At(point));
  return line;
}

GeoFeature PolygonOf(const RunScene::Object& each, const GeoPlane& plane) {
  GeoFeature polygon{Kind::kPolygon, OutlineOf(each, plane), PropertiesOf(each.object)};
  polygon.properties.emplace_back("name", each.name);
  polygon.properties.emplace_back("fill", Hex(each.colour));
  return polygon;
}

GeoFeature LoopLine(const RunScene::Loop& each, const GeoPlane& plane) {
  GeoFeature line = LineOf(each.name, each.colour, {each.match, each.query}, plane);
  const LoopClosure& loop = each.loop;
  line.properties.emplace_back("query_frame", static_cast<double>(loop.query_frame));
  line.properties.emplace_back("match_frame", static_cast<double>(loop.match_frame));
  line.properties.emplace_back("viewpoint_change_deg",
                               std::round(loop.viewpoint_change_rad * 18000 / M_PI) / 100);
  line.properties.emplace_back("objects", static_cast<double>(loop.pairs.size()));
  if (loop.probability) line.properties.emplace_back("probability", *loop.probability);
  return line;
}

}  // namespace

std::vector<GeoPoint> OutlineOf(const RunScene::Object& each, const GeoPlane& plane) {
  const Solid solid = each.round ? UnitCylinder() : UnitBox();
  std::vector<GeoPoint> outline;
  for (const std::vector<int>& face : solid.faces) {
    const auto is_on_top = [&solid](int corner) { return solid.corners[corner].z() > 0; };
    if (!std::all_of(face.begin(), face.end(), is_on_top)) continue;
    for (const int corner : face) {
      const Vec3 below(solid.corners[corner].x(), solid.corners[corner].y(), -.5);
      const MapObject& object = each.object;
      outline.push_back(plane.At(object.T_world_object * Vec3(below.cwiseProduct(object.dims))));
    }
  }
  return outline;
}

std::string RunGeoJson(const RunScene& scene, const GeoOrigin& origin) {
  const GeoPlane plane(origin, scene.T_world_first, scene.gravity.up);
  std::vector<GeoFeature> features;
  for (const RunScene::Path& path : scene.paths)
    features.push_back(LineOf(path.name, path.colour, path.points, plane));
  for (const RunScene::Object& object : scene.objects) features.push_back(PolygonOf(object, plane));
  for (const RunScene::Loop& loop : scene.loops) features.push_back(LoopLine(loop, plane));
  return GeoJsonText(features);
}

}  // namespace sslcd
