// SPDX-License-Identifier: BSD-3-Clause
#include "formats/geo_plane.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr double kRadiansOfDegree = M_PI / 180;
constexpr double kHighest = 1e5;  // [m]

double Rounded(double value, double steps_per_unit) {
  return std::round(value * steps_per_unit) / steps_per_unit;
}

}  // namespace

GeoOrigin ParseGeoOrigin(const std::string& text, double heading_deg) {
  std::vector<double> values;
  bool good = true;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto value = ParseNumber(std::string_view(text).substr(at, comma - at));
    good = good && value && std::isfinite(*value);
    values.push_back(value.value_or(0));
    at = comma + 1;
  }
  // the plane has no longitude at a pole
  if (!good || values.size() < 2 || values.size() > 3 || std::abs(values[0]) > 89 ||
      std::abs(values[1]) > 180 || (values.size() == 3 && std::abs(values[2]) > kHighest))
    throw Error(ErrorKind::kUsage,
                "'" + text +
                    "' is no origin: give LATITUDE,LONGITUDE or LATITUDE,LONGITUDE,ALTITUDE of the "
                    "first camera in degrees and metres, e.g. 49.01,8.43; latitude at most 89");
  if (!(std::abs(heading_deg) <= 360))
    throw Error(ErrorKind::kUsage,
                "the heading of the first camera is in degrees, clockwise from north: -360 to 360");
  GeoOrigin origin{values[0], values[1], std::nullopt, heading_deg};
  if (values.size() == 3) origin.altitude_m = values[2];
  return origin;
}

GeoPlane::GeoPlane(const GeoOrigin& origin, const Pose& T_world_first, const Vec3& up)
    : origin_(origin), centre_(T_world_first.translation()), up_(up) {
  Vec3 ahead = T_world_first.so3() * Vec3(0, 0, 1);
  ahead -= up * up.dot(ahead);
  // a camera that looks straight up or down has no heading
  ahead = ahead.norm() > 1e-6 ? Vec3(ahead.normalized()) : GravityFrame::FromUp(up).forward;
  const Vec3 left = up.cross(ahead);
  const double heading = origin.heading_deg * kRadiansOfDegree;
  north_ = std::cos(heading) * ahead + std::sin(heading) * left;
  east_ = std::sin(heading) * ahead - std::cos(heading) * left;
  // radii of curvature of the WGS 84 ellipsoid, along the meridian and across it
  constexpr double kEquator = 6378137, kEccentricity2 = 6.69437999014e-3;
  const double sine = std::sin(origin.latitude_deg * kRadiansOfDegree);
  const double root = std::sqrt(1 - kEccentricity2 * sine * sine);
  along_m_ = kEquator * (1 - kEccentricity2) / (root * root * root);
  across_m_ = kEquator / root * std::cos(origin.latitude_deg * kRadiansOfDegree);
}

GeoPoint GeoPlane::At(const Vec3& point) const {
  const Vec3 offset = point - centre_;
  const double further_deg = offset.dot(east_) / across_m_ / kRadiansOfDegree;
  const double latitude_deg =
      origin_.latitude_deg + offset.dot(north_) / along_m_ / kRadiansOfDegree;
  if (!(std::abs(further_deg) <= 180 && std::abs(latitude_deg) <= 90))
    throw Error(ErrorKind::kBadInput,
                "the map is too large to be placed on the Earth at this origin: check the unit of "
                "its poses (metres), and the origin");
  GeoPoint place{Rounded(origin_.longitude_deg + further_deg, 1e9), Rounded(latitude_deg, 1e9),
                 std::nullopt};
  if (origin_.altitude_m) place.altitude_m = Rounded(*origin_.altitude_m + offset.dot(up_), 1e3);
  return place;
}

}  // namespace sslcd
