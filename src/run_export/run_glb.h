// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run_export/run_scene.h"

namespace sslcd {

/// Returns a binary glTF 2.0 file. y is up, x and z as in PageAxes(), the origin is the first
/// camera. `extras.T_world_file` of the root node has the transform back to the world, row by row.
std::string RunGlb(const RunScene& scene);

}  // namespace sslcd
