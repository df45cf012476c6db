// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "formats/map_json.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Cuboids of the confirmed objects (faces) and camera positions (points): ASCII PLY.
std::string PlyText(const MapFile& map, const Trajectory& trajectory);

}  // namespace sslcd
