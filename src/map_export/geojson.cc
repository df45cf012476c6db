// SPDX-License-Identifier: BSD-3-Clause
#include "map_export/geojson.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/json_text.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kRadians = M_PI / 180;

// Longitude and latitude of points of the map.
class GeoPlane {
 public:
  GeoPlane(const GeoOrigin& origin, const Pose& T_world_first, const Vec3& up)
      : origin_(origin), centre_(T_world_first.translation()) {
    Vec3 ahead = T_world_first.so3() * Vec3(0, 0, 1);
    ahead -= up * up.dot(ahead);
    // a camera that looks straight up or down has no heading
    ahead = ahead.norm() > 1e-6 ? Vec3(ahead.normalized()) : GravityFrame::FromUp(up).forward;
    const Vec3 left = up.cross(ahead);
    const double heading = origin.heading_deg * kRadians;
    north_ = std::cos(heading) * ahead + std::sin(heading) * left;
    east_ = std::sin(heading) * ahead - std::cos(heading) * left;
    // radii of curvature of the WGS 84 ellipsoid, along the meridian and across it
    constexpr double kEquator = 6378137, kEccentricity2 = 6.69437999014e-3;
    const double sine = std::sin(origin.latitude_deg * kRadians);
    const double root = std::sqrt(1 - kEccentricity2 * sine * sine);
    along_m_ = kEquator * (1 - kEccentricity2) / (root * root * root);
    across_m_ = kEquator / root * std::cos(origin.latitude_deg * kRadians);
  }

  Json At(const Vec3& point) const {
    const Vec3 offset = point - centre_;
    return Json::array({Rounded(origin_.longitude_deg + offset.dot(east_) / across_m_ / kRadians),
                        Rounded(origin_.latitude_deg + offset.dot(north_) / along_m_ / kRadians)});
  }

 private:
  static double Rounded(double degrees) { return std::round(degrees * 1e9) / 1e9; }

  GeoOrigin origin_;
  Vec3 centre_, north_, east_;
  double along_m_ = 0, across_m_ = 0;
};

Json Feature(const char* type, Json coordinates, Json properties) {
  Json feature;
  feature["type"] = "Feature";
  feature["geometry"] = {{"type", type}, {"coordinates", std::move(coordinates)}};
  feature["properties"] = std::move(properties);
  return feature;
}

}  // namespace

GeoOrigin ParseGeoOrigin(const std::string& text) {
  std::vector<double> values;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto value = ParseNumber(std::string_view(text).substr(at, comma - at));
    values.push_back(value && std::isfinite(*value) ? *value : 1e9);
    at = comma + 1;
  }
  // the plane has no longitude at a pole
  if (values.size() != 3 || std::abs(values[0]) > 89 || std::abs(values[1]) > 180 ||
      std::abs(values[2]) > 360)
    throw Error(ErrorKind::kUsage,
                "'" + text +
                    "' is no origin: give LATITUDE,LONGITUDE,HEADING of the first camera "
                    "in degrees, e.g. 49.01,8.43,120; latitude at most 89");
  return {values[0], values[1], values[2]};
}

std::string GeoJsonText(const MapInfo& info, const MapResults& results, const GeoOrigin& origin) {
  Json root;
  root["type"] = "FeatureCollection";
  Json& features = root["features"] = Json::array();
  if (results.paths.empty()) return JsonText(root, features);
  const GeoPlane plane(origin, results.paths[0].trajectory.poses[0], info.up_axis);
  for (const SessionPath& path : results.paths) {
    Json line = Json::array();
    for (const Pose& pose : path.trajectory.poses) line.push_back(plane.At(pose.translation()));
    if (line.size() == 1) line.push_back(line[0]);  // a line has two points at least
    for (const SessionInfo& session : info.sessions)
      if (session.id == path.session)
        features.push_back(Feature("LineString", line, {{"session", session.name}}));
  }
  for (const MapObject& object : results.objects)
    if (object.state == LandmarkState::kConfirmed)
      features.push_back(Feature("Point", plane.At(object.T_world_object.translation()),
                                 {{"landmark", object.id.value},
                                  {"label", object.label},
                                  {"sightings", object.observations.size()},
                                  {"length_m", object.dims.x()},
                                  {"width_m", object.dims.y()},
                                  {"height_m", object.dims.z()}}));
  return JsonText(root, features);
}

}  // namespace sslcd
