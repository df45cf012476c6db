// SPDX-License-Identifier: BSD-3-Clause
#include "formats/geojson.h"

#include <nlohmann/json.hpp>

#include "formats/json_text.h"

namespace sslcd {
namespace {

using Json = nlohmann::ordered_json;

Json PositionOf(const GeoPoint& point) {
  Json position = {point.longitude_deg, point.latitude_deg};
  if (point.altitude_m) position.push_back(*point.altitude_m);
  return position;
}

Json GeometryOf(const GeoFeature& feature) {
  if (feature.kind == GeoFeature::Kind::kPoint)
    return {{"type", "Point"}, {"coordinates", PositionOf(feature.points.at(0))}};
  Json positions = Json::array();
  for (const GeoPoint& point : feature.points) positions.push_back(PositionOf(point));
  const bool closed = feature.kind == GeoFeature::Kind::kPolygon;
  if (closed || positions.size() == 1) positions.push_back(Json(positions[0]));
  if (closed) return {{"type", "Polygon"}, {"coordinates", Json::array({std::move(positions)})}};
  return {{"type", "LineString"}, {"coordinates", std::move(positions)}};
}

}  // namespace

GeoProperties PropertiesOf(const MapObject& object) {
  return {{"landmark", static_cast<double>(object.id.value)},
          {"label", object.label},
          {"sightings", static_cast<double>(object.observations.size())},
          {"length_m", object.dims.x()},
          {"width_m", object.dims.y()},
          {"height_m", object.dims.z()}};
}

std::string GeoJsonText(const std::vector<GeoFeature>& features) {
  Json root;
  root["type"] = "FeatureCollection";
  Json& list = root["features"] = Json::array();
  for (const GeoFeature& feature : features) {
    Json json;
    json["type"] = "Feature";
    json["geometry"] = GeometryOf(feature);
    Json& properties = json["properties"] = Json::object();
    for (const auto& [name, value] : feature.properties)
      std::visit([&, &key = name](const auto& each) { properties[key] = each; }, value);
    list.push_back(std::move(json));
  }
  return JsonText(root, list);
}

}  // namespace sslcd
