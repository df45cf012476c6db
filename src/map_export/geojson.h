// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/store/map_store.h"

namespace sslcd {

/// Where the first camera of a map is on the Earth (WGS 84), and where it looks.
struct GeoOrigin {
  double latitude_deg = 0, longitude_deg = 0;
  double heading_deg = 0;  ///< of the camera's viewing direction, clockwise from north
};

/// "LAT,LON,HEADING" in degrees. Throws Error(kUsage).
GeoOrigin ParseGeoOrigin(const std::string& text);

/// The text of a GeoJSON file (RFC 7946): a line per session, a point per confirmed landmark. On
/// the plane that touches the ellipsoid at the origin: 10 km from there this is off by 9 m at 45
/// degrees of latitude. Longitude and latitude have 9 decimals, 0.1 mm.
std::string GeoJsonText(const MapInfo& info, const MapResults& results, const GeoOrigin& origin);

}  // namespace sslcd
