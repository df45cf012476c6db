// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/change/map_history.h"
#include "store/database.h"

namespace sslcd {

/// What was there when, by the results and the inputs that they were made from. O(inputs)
MapHistory ReadHistory(Database& database);

}  // namespace sslcd
