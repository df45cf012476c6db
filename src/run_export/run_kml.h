// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "formats/geo_plane.h"
#include "run_export/run_scene.h"

namespace sslcd {

/// Returns a KML 2.2 file with folders of paths, objects by label, and loops. Objects stand on the
/// viewer's ground, with their heights. Paths and loops lie on it, unless the origin has an
/// altitude.
std::string RunKml(const RunScene& scene, const GeoOrigin& origin);

}  // namespace sslcd
