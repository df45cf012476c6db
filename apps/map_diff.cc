// SPDX-License-Identifier: BSD-3-Clause
#include "map_diff.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "map_export/map_diff.h"

namespace sslcd::apps {
namespace {

using Json = nlohmann::ordered_json;

Json EvidenceJson(const SessionEvidence& evidence) {
  return {{"seen", evidence.seen},
          {"expected", evidence.expected},
          {"probability", evidence.probability}};
}

Json ChangeJson(const MapDiff& diff, const PlaceChange& change, const PlaceHistory& place) {
  Json landmarks = Json::array();
  for (const LandmarkId landmark : place.landmarks) landmarks.push_back(landmark.value);
  const Vec3& position = place.T_world_object.translation();
  return {{"change", ToString(change.kind)},
          {"probability", change.probability},
          {"label", place.label},
          {"landmarks", landmarks},
          {"position", {position.x(), position.y(), position.z()}},
          {"from", EvidenceJson(place.sessions[diff.from])},
          {"to", EvidenceJson(place.sessions[diff.to])}};
}

Json DiffJson(const MapInfo& info, const MapHistory& history, const MapDiff& diff) {
  Json json, changes = Json::array(), rates = Json::object();
  for (const PlaceChange& change : diff.changes)
    changes.push_back(ChangeJson(diff, change, history.places()[change.place]));
  for (const auto& [label, rate] : history.rates())
    rates[label] = {
        {"departure", rate.departure}, {"replaced", rate.replaced}, {"arrival", rate.arrival}};
  json["from"] = info.sessions[diff.from].name;
  json["to"] = info.sessions[diff.to].name;
  json["stayed"] = diff.stayed;
  json["unknown"] = diff.unknown;
  json["not_in_view_of_both"] = diff.unseen;
  json["rates"] = rates;
  json["changes"] = changes;
  return json;
}

std::string SeenText(const SessionEvidence& evidence) {
  return std::to_string(evidence.seen) + " of " + Number("%.1f", evidence.expected);
}

void PrintTable(const MapInfo& info, const MapHistory& history, const MapDiff& diff,
                const Console& console) {
  const std::string &from = info.sessions[diff.from].name, &to = info.sessions[diff.to].name;
  console.Say("from '" + from + "' to '" + to + "': " + std::to_string(diff.changes.size()) +
              " changes, " + std::to_string(diff.stayed) + " objects stayed, " +
              std::to_string(diff.unknown) + " unknown, " + std::to_string(diff.unseen) +
              " not in view of both");
  if (diff.changes.empty()) return;
  std::vector<std::vector<std::string>> rows = {
      {"change", "probability", "label", "landmark", "x", "y", "z", "seen in from", "in to"}};
  for (const PlaceChange& change : diff.changes) {
    const PlaceHistory& place = history.places()[change.place];
    const Vec3& p = place.T_world_object.translation();
    rows.push_back({ToString(change.kind), Number("%.3f", change.probability), place.label,
                    std::to_string(place.landmarks.front().value), Number("%.2f", p.x()),
                    Number("%.2f", p.y()), Number("%.2f", p.z()),
                    SeenText(place.sessions[diff.from]), SeenText(place.sessions[diff.to])});
  }
  console.Say(AlignedTable(rows));
}

}  // namespace

void PrintMapDiff(const std::string& file, const MapDiffArguments& a, const Console& console) {
  const MapStore store(file);
  const MapInfo info = store.Describe();
  const MapHistory history = store.History();
  const MapDiff diff = CompareSessions(info, history, a.from, a.to);
  if (!a.csv.empty()) WriteFileAtomically(a.csv, DiffCsv(diff, history));
  if (a.json) {
    const auto replace = Json::error_handler_t::replace;
    std::printf("%s\n", DiffJson(info, history, diff).dump(2, ' ', false, replace).c_str());
    return;
  }
  PrintTable(info, history, diff, console);
  if (!a.csv.empty()) console.Say("wrote " + a.csv);
}

}  // namespace sslcd::apps
