// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "map_export/geojson.h"
#include "sslcd/store/map_store.h"

namespace sslcd {

/// Writes the results of a map as the files of a run folder (docs/formats.md), with the frame
/// numbers of the map: map.json, map.ply, graph.g2o, loops.csv and config.yaml, and for each
/// session a folder of its name with trajectories and odometry. The same results give the same
/// bytes. With an origin also map.geojson, which is removed otherwise if an earlier export wrote
/// here. Returns the paths. Locks the folder; the files are a FileSet of the name "map". Throws
/// Error(kOutput).
std::vector<std::string> ExportMap(const MapInfo& info, const MapResults& results,
                                   const std::string& folder,
                                   const std::optional<GeoOrigin>& origin = std::nullopt);

}  // namespace sslcd
