// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Where the first camera of a map is on the Earth (WGS 84), and where it looks.
struct GeoOrigin {
  double latitude_deg = 0, longitude_deg = 0;
  std::optional<double> altitude_m;
  double heading_deg = 0;  ///< of the camera's viewing direction, clockwise from north
};

/// "LAT,LON" or "LAT,LON,ALT" in degrees and metres, with a heading. Throws Error(kUsage).
GeoOrigin ParseGeoOrigin(const std::string& text, double heading_deg);

/// A point on the Earth. Longitude and latitude have 9 decimals, 0.1 mm.
struct GeoPoint {
  double longitude_deg = 0, latitude_deg = 0;
  std::optional<double> altitude_m;  ///< none: that of the ground
};

/// The plane that touches the ellipsoid at the origin: 10 km from there it is off by 9 m at 45
/// degrees of latitude.
class GeoPlane {
 public:
  GeoPlane(const GeoOrigin& origin, const Pose& T_world_first, const Vec3& up);

  /// The place of a point of the world; a longitude beyond 180 degrees stays so. Throws
  /// Error(kBadInput) beyond a pole, or half around the Earth.
  GeoPoint At(const Vec3& point) const;

 private:
  GeoOrigin origin_;
  Vec3 centre_, up_, north_, east_;
  double along_m_ = 0, across_m_ = 0;  // of a radian of latitude, of longitude
};

}  // namespace sslcd
