// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/store/map_session.h"

namespace sslcd {

/// A name becomes that of a folder (`sslcd_run map export`). Throws Error(kUsage) if it cannot.
void CheckSessionName(const std::string& name);

/// The session that a map would have next: its number, and that of its first frame. Throws
/// Error(kUsage) if the name cannot be used or is taken, or a session has not been ended.
SessionInfo NewSession(const MapInfo& info, const std::string& path, const SessionRequest& request);

}  // namespace sslcd
