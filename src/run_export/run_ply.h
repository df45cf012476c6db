// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run_export/run_scene.h"

namespace sslcd {

/// Returns an ASCII PLY file in the world of the run: objects as faces, paths and loops as edges.
std::string RunPly(const RunScene& scene);

}  // namespace sslcd
