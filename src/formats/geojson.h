// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "formats/geo_plane.h"
#include "sslcd/core/landmark.h"

namespace sslcd {

using GeoProperties = std::vector<std::pair<std::string, std::variant<std::string, double>>>;

/// A feature of a GeoJSON file.
struct GeoFeature {
  enum class Kind { kPoint, kLine, kPolygon };
  Kind kind = Kind::kPoint;
  /// of a polygon: its corners, counter-clockwise from above, each once
  std::vector<GeoPoint> points;
  GeoProperties properties;
};

/// landmark, label, sightings, length_m, width_m and height_m.
GeoProperties PropertiesOf(const MapObject& object);

/// Returns the text of a GeoJSON file (RFC 7946), one line per feature. A line of one point gets it
/// twice.
std::string GeoJsonText(const std::vector<GeoFeature>& features);

}  // namespace sslcd
