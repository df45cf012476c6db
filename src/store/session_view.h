// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/store/map_store.h"

namespace sslcd {

/// What a map holds of one session, with the frame numbers of its drive: its path, the landmarks
/// that it has seen, the loops within it, its part of the pose graph.
MapResults ResultsOfSession(const MapResults& map, const SessionInfo& session);

/// The number of accepted loops that join a session to earlier ones.
int LoopsToEarlierSessions(const MapResults& map, const SessionInfo& session);

/// The names of the other sessions that have a common map with this one, at least with a part of
/// it.
std::vector<std::string> JoinedSessions(const MapInfo& info, const MapResults& map,
                                        const SessionInfo& session);

}  // namespace sslcd
