// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/closing/localisation.h"
#include "sslcd/store/map_store.h"
#include "store/database.h"

namespace sslcd {

/// The confirmed landmarks of a map as a map to localise in. Reads the inputs for their looks from
/// each side.
ReferenceMap ReferenceOf(Database& database, const MapInfo& info, const MapResults& results);

}  // namespace sslcd
