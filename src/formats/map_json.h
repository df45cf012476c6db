// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/landmark.h"

namespace sslcd {

/// The content of map.json (docs/formats.md).
struct MapFile {
  Vec3 up_axis{0, -1, 0};  ///< unit vector in the world frame
  std::vector<MapObject> objects;
};

/// Returns the text of map.json, version 1. ReadMapJson returns exactly the same numbers.
std::string MapJson(const MapFile& map);

/// Reads map.json. Throws Error(kBadInput) with file and line if the file is not JSON, has another
/// format or version, or has missing or wrong keys.
MapFile ReadMapJson(const std::string& path);

}  // namespace sslcd
