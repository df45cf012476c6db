// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/export.h"

namespace sslcd {

/// Throws Error(kBadInput) if there is a folder, a pipe, a device or a socket at the path. Reading
/// a pipe waits until something writes, and some devices never end.
SSLCD_EXPORT void RequireRegularFile(const std::string& path);

}  // namespace sslcd
