// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "formats/geo_plane.h"
#include "run_export/run_scene.h"

namespace sslcd {

/// The outline of an object on the ground, counter-clockwise from above.
std::vector<GeoPoint> OutlineOf(const RunScene::Object& object, const GeoPlane& plane);

/// Returns the text of a GeoJSON file: a line per path and loop, a polygon per object, with the
/// colours of simplestyle-spec 1.1.
std::string RunGeoJson(const RunScene& scene, const GeoOrigin& origin);

}  // namespace sslcd
