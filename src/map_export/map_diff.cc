// SPDX-License-Identifier: BSD-3-Clause
#include "map_export/map_diff.h"

#include <algorithm>
#include <optional>

#include "formats/csv.h"
#include "formats/number_text.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr double kCalled = 0.5;

bool InView(const PlaceHistory& place, int from, int to) {
  return place.sessions[from].InView() && place.sessions[to].InView();
}

bool SeeCommonGround(const MapHistory& history, int from, int to) {
  return std::any_of(history.places().begin(), history.places().end(),
                     [&](const PlaceHistory& place) { return InView(place, from, to); });
}

std::string Names(const MapInfo& info) {
  std::string names;
  for (const SessionInfo& session : info.sessions)
    names += (names.empty() ? "'" : ", '") + session.name + "'";
  return names;
}

// None for an empty name.
std::optional<int> NumberOf(const MapInfo& info, const std::string& name) {
  if (name.empty()) return std::nullopt;
  for (std::size_t i = 0; i < info.sessions.size(); ++i)
    if (info.sessions[i].name == name) return static_cast<int>(i);
  throw Error(ErrorKind::kUsage, "the map has no session '" + name + "'; it has " + Names(info));
}

// The last pair that sees common ground.
std::optional<std::pair<int, int>> ChoosePair(const MapInfo& info, const MapHistory& history,
                                              std::optional<int> from, std::optional<int> to) {
  for (int b = to.value_or(static_cast<int>(info.sessions.size()) - 1); b > 0; --b) {
    for (int a = from.value_or(b - 1); a >= 0 && a < b; --a) {
      if (SeeCommonGround(history, a, b)) return std::make_pair(a, b);
      if (from) break;
    }
    if (to) break;
  }
  return std::nullopt;
}

std::optional<PlaceChange> ChangeOf(const PlaceOutcome& outcome, int place) {
  const double gone = outcome.Departure(), come = outcome.Arrival();
  if (std::min(gone, come) >= kCalled)
    return PlaceChange{ChangeKind::kReplaced, std::min(gone, come), place};
  if (gone >= kCalled) return PlaceChange{ChangeKind::kDeparted, gone, place};
  if (come >= kCalled) return PlaceChange{ChangeKind::kArrived, come, place};
  return std::nullopt;
}

}  // namespace

const char* ToString(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::kDeparted: return "departed";
    case ChangeKind::kArrived: return "arrived";
    case ChangeKind::kReplaced: return "replaced";
  }
  return "";
}

MapDiff CompareSessions(const MapInfo& info, const MapHistory& history, const std::string& from,
                        const std::string& to) {
  const std::optional<int> first = NumberOf(info, from), second = NumberOf(info, to);
  if (info.sessions.size() < 2)
    throw Error(ErrorKind::kUsage, "the map has one session only, " + Names(info) +
                                       ": nothing to compare; add another drive");
  if (first && second && *first >= *second)
    throw Error(ErrorKind::kUsage,
                "session '" + from + "' is not before '" + to +
                    "': give the earlier one to --from; in order of time: " + Names(info));
  const auto pair = ChoosePair(info, history, first, second);
  if (!pair)
    throw Error(ErrorKind::kNoSolution,
                "no place was in view of both sessions: they have no common map yet, or went "
                "elsewhere (`sslcd_run map info`)");
  MapDiff diff;
  diff.from = pair->first;
  diff.to = pair->second;
  for (std::size_t i = 0; i < history.places().size(); ++i) {
    const PlaceHistory& place = history.places()[i];
    const PlaceOutcome outcome = history.Between(static_cast<int>(i), diff.from, diff.to);
    const std::optional<PlaceChange> change = ChangeOf(outcome, static_cast<int>(i));
    if (!InView(place, diff.from, diff.to))
      diff.unseen += place.sessions[diff.from].seen + place.sessions[diff.to].seen > 0 ? 1 : 0;
    else if (change)
      diff.changes.push_back(*change);
    else if (outcome.stayed >= kCalled)
      ++diff.stayed;
    else if (outcome.empty < kCalled)
      ++diff.unknown;
  }
  std::stable_sort(diff.changes.begin(), diff.changes.end(), [](const auto& a, const auto& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.probability > b.probability;
  });
  return diff;
}

std::string DiffCsv(const MapDiff& diff, const MapHistory& history) {
  std::string text =
      "change,probability,label,landmark,x,y,z,seen_from,expected_from,seen_to,expected_to\n";
  for (const PlaceChange& change : diff.changes) {
    const PlaceHistory& place = history.places()[change.place];
    text += std::string(ToString(change.kind)) + "," + FixedNumber(change.probability, 3) + "," +
            CsvField(place.label) + "," + std::to_string(place.landmarks.front().value);
    for (const double value : place.T_world_object.translation())
      text += "," + FixedNumber(value, 3);
    for (const int session : {diff.from, diff.to})
      text += "," + std::to_string(place.sessions[session].seen) + "," +
              FixedNumber(place.sessions[session].expected, 1);
    text += "\n";
  }
  return text;
}

}  // namespace sslcd
