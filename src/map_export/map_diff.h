// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/change/map_history.h"
#include "sslcd/store/map_store.h"

namespace sslcd {

enum class ChangeKind { kDeparted, kArrived, kReplaced };
/// "departed", "arrived", "replaced".
const char* ToString(ChangeKind kind);

/// A place that has changed from a session to a later one.
struct PlaceChange {
  ChangeKind kind = ChangeKind::kDeparted;
  /// that the object has gone, that another one has come, the smaller one of both if it was
  /// replaced
  double probability = 0;
  int place = 0;  ///< number in MapHistory::places
};

struct MapDiff {
  int from = 0, to = 0;              ///< numbers in MapInfo::sessions
  std::vector<PlaceChange> changes;  ///< by kind, the most probable first
  int stayed = 0;                    ///< places in view of both sessions where the same object is
  int unknown = 0;  ///< other places in view of both, where something was in one of them
  int unseen = 0;   ///< places with something in one of the sessions that the other has not seen
};

/// The changes between two sessions, by their names. A change has a probability of at least 0.5,
/// and its place was in view of both. An empty name: `to` is the last session, `from` the last one
/// before `to`, that have a place in view in common. Throws Error(kUsage) for an unknown name, the
/// wrong order or a map of one session, Error(kNoSolution) if no place was in view of both.
MapDiff CompareSessions(const MapInfo& info, const MapHistory& history, const std::string& from,
                        const std::string& to);

/// A CSV file with a row per change (docs/change.md).
std::string DiffCsv(const MapDiff& diff, const MapHistory& history);

}  // namespace sslcd
