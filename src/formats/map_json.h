// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/landmark.h"

namespace sslcd {

/// A finished map as it lies on disk (docs/formats.md, "map.json").
struct MapFile {
  Vec3 up_axis{0, -1, 0};
  std::vector<MapObject> objects;
};

/// map.json's text, version 1. Numbers read back to the bit.
std::string MapJson(const MapFile& map);

/// Reads map.json. Throws Error(kBadInput) with file and line: not JSON, another format or version,
/// missing or wrong keys.
MapFile ReadMapJson(const std::string& path);

}  // namespace sslcd
