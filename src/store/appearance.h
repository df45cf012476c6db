// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/store/map_store.h"
#include "store/database.h"

namespace sslcd {

/// Fills the table of appearance: the means of the vectors in the inputs over the sightings of each
/// confirmed landmark. The table must be empty. O(inputs)
void WriteAppearance(Database& database, const std::vector<MapObject>& objects,
                     const std::vector<SessionInfo>& sessions);

}  // namespace sslcd
