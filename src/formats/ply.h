// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "formats/map_json.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Returns an ASCII PLY file with the cuboids of the confirmed objects (faces) and the camera
/// positions (points).
std::string PlyText(const MapFile& map, const Trajectory& trajectory);

}  // namespace sslcd
