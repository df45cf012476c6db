// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/export.h"

namespace sslcd {

/// The time now, e.g. "2026-11-23T17:40:06Z". Only for people: nothing is computed from it.
SSLCD_EXPORT std::string UtcTime();

}  // namespace sslcd
