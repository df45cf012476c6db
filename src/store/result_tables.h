// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/store/map_store.h"
#include "store/database.h"

namespace sslcd {

/// Replaces the tables of results, and their checksums. The odometry of the paths is not written:
/// it is among the inputs.
void WriteResults(Database& database, const MapResults& results,
                  const std::vector<SessionInfo>& sessions);

/// Reads the tables of results. Paths have no odometry.
MapResults ReadResults(Database& database);

}  // namespace sslcd
