// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

/// Which maps become one.
struct MergeRequest {
  std::string into;               ///< the map that the sessions are added to
  std::vector<std::string> from;  ///< maps that they are taken from, in this order; only read
  std::string out{};              ///< a new file for the merged map; empty: `into` itself
  /// A session whose name is taken gets the first free one of "NAME-2", "NAME-3" ...; false: it is
  /// refused.
  bool rename = false;
  /// Refines the map once, after the last session, instead of as often as the sessions were: most
  /// of the time of merging many maps is for that. The result is no longer that of drives recorded
  /// in the map, and views that were aligned are left out but for those of the last session.
  bool refine_once = false;
  /// Called after each frame that is added, with the number of frames that are done and of all to
  /// add; false: stop. Not called while `into` is replayed, before the first one.
  std::function<bool(int, int)> progress{};
};

/// A session that has been added.
struct MergedSession {
  std::string map;       ///< file that it comes from
  std::string old_name;  ///< in that file
  std::string name;      ///< in the merged map
  int frames = 0;
};

struct MergeReport {
  bool stopped = false;  ///< by `progress`: no file has changed
  std::vector<MergedSession> added;
  /// sessions that have not been ended, as "FILE: NAME": they are left out
  std::vector<std::string> left_out;
};

/// Adds the ended sessions of some maps to a map, as if their drives had been recorded in it: the
/// inputs of each session are given to the mapper again, so the drives themselves are not needed.
/// The same rules hold as for a session (MapSession::Begin), and a session may not be there twice.
///
/// All or nothing: the work is done in a copy, FILE-merge, whose content replaces that of the map
/// in one transaction. A process that is killed leaves the map as it was; the next merge removes
/// the copy. Readers may go on all the time.
///
/// Throws what MapStore throws for a file that is no sound map; Error(kBadInput) for another site:
/// up axis, symmetry of a label, length of vectors; Error(kUsage) for other options, a name that is
/// taken, a session that is in the map already, no session to add, a session of `into` that has not
/// been ended, `out` that exists; Error(kOutput) if a file cannot be written. The map is unchanged
/// then. O(all frames of the merged map).
MergeReport MergeMaps(const MergeRequest& request);

}  // namespace sslcd
