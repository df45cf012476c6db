// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "formats/file_lock.h"

namespace sslcd {

/// Locks PATH-lock, as each writer of the map does. Throws Error(kOutput) as FileLock does.
inline FileLock LockMap(const std::string& path) {
  return FileLock(path + "-lock", path, "wait until it has ended. Reading is possible at any time");
}

}  // namespace sslcd
