// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "formats/geo_plane.h"
#include "sslcd/store/map_store.h"

namespace sslcd {

/// The text of a GeoJSON file: a line per session, a point per confirmed landmark.
std::string MapGeoJson(const MapInfo& info, const MapResults& results, const GeoOrigin& origin);

}  // namespace sslcd
