// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "store/merge_source.h"

namespace sslcd {

/// A session that is to be added to a map.
struct PlannedSession {
  std::size_t source = 0;  ///< index of its map
  SessionInfo session;     ///< in that map
  std::string name;        ///< in the merged map
};

/// The ended sessions of the sources in order, with the names that they get in the map `into`. Two
/// sessions with the same frames are one drive, whatever was refined and whether 2D boxes are used.
/// Throws Error, with the names of both files, if they cannot be added: kBadInput for another site,
/// kUsage for other options, a name that is taken without `rename`, a session that is there
/// already, or nothing to add.
std::vector<PlannedSession> PlanMerge(const MergeSource& into,
                                      const std::vector<MergeSource>& sources, bool rename);

}  // namespace sslcd
