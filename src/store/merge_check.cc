// SPDX-License-Identifier: BSD-3-Clause
#include "store/merge_check.h"

#include <map>
#include <set>

#include "sslcd/core/error.h"
#include "store/site.h"

namespace sslcd {
namespace {

// `known` holds the lengths of the maps so far.
void CheckLengths(const MergeSource& source, const std::string& path, PerCue<int>& known) {
  for (const CueRow& row : kCueRows) {
    const int length = source.info.vector_length[row.cue];
    if (known[row.cue] == 0) known[row.cue] = length;
    if (length == 0 || length == known[row.cue]) continue;
    throw Error(ErrorKind::kBadInput,
                source.path + ": its " + row.name + " vectors have " + std::to_string(length) +
                    " numbers, and those of " + path + " " + std::to_string(known[row.cue]) +
                    ": they come from another model, so these maps cannot be merged");
  }
}

void CheckSite(const MapInfo& into, const std::string& path, const MergeSource& source) {
  try {
    CheckBelongs(into, path, {GravityFrame::FromUp(source.info.up_axis), source.info.labels, {}},
                 OptionsOf(source.info, source.path));
  } catch (const Error& error) {
    throw Error(
        error.kind(),
        source.path + " cannot be merged ('here' and 'this drive' are this map): " + error.what());
  }
}

// A checksum over the frames of each session, by its id. Not that of all its inputs: those of a
// refinement depend on the map. 2D boxes are stored only where the map has a camera for them.
std::map<int, std::string> FrameChecksums(const MergeSource& map) {
  std::map<int, std::string> checksums;
  for (const StoredInput& input : map.inputs) {
    if (input.kind != InputKind::kFrame) continue;
    Frame frame = FrameIn(input, map.path);
    for (Detection& detection : frame.detections) detection.box.reset();
    const auto checksum = checksums.insert({input.session, FirstChecksum()}).first;
    checksum->second = NextChecksum(checksum->second, input.kind, FrameBytes(frame));
  }
  return checksums;
}

// The names of the sessions so far; by the checksum of its frames, where each one is.
struct Sessions {
  std::set<std::string> names;
  std::map<std::string, std::string> places;
};

std::string NameFor(const SessionInfo& session, const std::string& map, const std::string& into,
                    bool rename, const Sessions& taken) {
  if (taken.names.count(session.name) == 0) return session.name;
  if (!rename)
    throw Error(ErrorKind::kUsage, into + ": has a session '" + session.name + "' already, as " +
                                       map +
                                       " has; rename gives the latter a free name (--rename)");
  for (int i = 2;; ++i)
    if (const std::string name = session.name + "-" + std::to_string(i);
        taken.names.count(name) == 0)
      return name;
}

void RefuseTwice(const SessionInfo& session, const std::string& checksum, const std::string& map,
                 const Sessions& taken) {
  const auto same = taken.places.find(checksum);
  if (same != taken.places.end())
    throw Error(ErrorKind::kUsage, map + ": session '" + session.name + "' is the same drive as " +
                                       same->second + "; leave this map out");
}

}  // namespace

std::vector<PlannedSession> PlanMerge(const MergeSource& into,
                                      const std::vector<MergeSource>& sources, bool rename) {
  std::vector<PlannedSession> plan;
  Sessions taken;
  const auto take = [&](const std::string& name, const std::string& checksum,
                        const std::string& map) {
    taken.names.insert(name);
    if (!checksum.empty()) taken.places[checksum] = "session '" + name + "' of " + map;
  };
  std::map<int, std::string> checksums = FrameChecksums(into);
  for (const SessionInfo& session : into.info.sessions) {
    if (!session.ended)
      throw Error(ErrorKind::kUsage, into.path + ": session '" + session.name +
                                         "' has not been ended; go on with it, or end it as it is "
                                         "(`sslcd_run map end`), and merge then");
    take(session.name, checksums[session.id], into.path);
  }
  MapInfo merged = into.info;                                // grows by the labels of each source
  merged.config = ConfigText(OptionsOf(merged, into.path));  // with the keys of this version
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const MergeSource& source = sources[i];
    CheckSite(merged, into.path, source);
    CheckLengths(source, into.path, merged.vector_length);
    for (const auto& [name, label] : source.info.labels.entries()) merged.labels.Set(name, label);
    checksums = FrameChecksums(source);
    for (const SessionInfo& session : source.info.sessions) {
      if (!session.ended) continue;
      const std::string& checksum = checksums[session.id];
      RefuseTwice(session, checksum, source.path, taken);
      plan.push_back({i, session, NameFor(session, source.path, into.path, rename, taken)});
      take(plan.back().name, checksum, source.path);
    }
  }
  if (plan.empty())
    throw Error(ErrorKind::kUsage,
                "no session to add: none of the other maps has one that has been ended (`sslcd_run "
                "map end` ends one)");
  return plan;
}

}  // namespace sslcd
