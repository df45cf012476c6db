// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/sha256.h"
#include "examples.h"
#include "geo_arguments.h"
#include "map_diff.h"
#include "map_export/export_map.h"
#include "map_merge.h"
#include "sslcd/core/error.h"
#include "sslcd/store/map_session.h"
#include "store/session_view.h"
#include "written.h"

namespace sslcd::apps {
namespace {

struct MapCommandArguments {
  std::string file, out;
  GeoArguments geo;
  bool json = false;
  MapDiffArguments diff;
  MapMergeArguments merge;
};

struct MapCounts {
  int landmarks = 0, loops = 0;
  double path_m = 0;
};

MapCounts CountsOf(const MapResults& results) {
  MapCounts counts;
  for (const MapObject& object : results.objects)
    counts.landmarks += object.state == LandmarkState::kConfirmed ? 1 : 0;
  for (const LoopClosure& loop : results.loops)
    counts.loops += loop.decision == LoopDecision::kAccepted ? 1 : 0;
  for (const SessionPath& path : results.paths)
    for (std::size_t i = 1; i < path.trajectory.size(); ++i)
      counts.path_m +=
          (path.trajectory.poses[i].translation() - path.trajectory.poses[i - 1].translation())
              .norm();
  return counts;
}

nlohmann::ordered_json JsonOf(const MapInfo& info, const MapResults& results) {
  nlohmann::ordered_json json, sessions = nlohmann::ordered_json::array();
  const MapCounts counts = CountsOf(results);
  json["file_bytes"] = info.file_bytes;
  json["created"] = info.created;
  json["landmarks"] = counts.landmarks;
  json["loops_accepted"] = counts.loops;
  json["path_m"] = counts.path_m;
  json["results_after_inputs"] = results.inputs;
  for (const SessionInfo& session : info.sessions)
    sessions.push_back({{"name", session.name},
                        {"ended", session.ended},
                        {"frames", session.frames},
                        {"frame_offset", session.frame_offset},
                        {"common_map_with", JoinedSessions(info, results, session)},
                        {"loops_to_earlier_sessions", LoopsToEarlierSessions(results, session)},
                        {"checksum", Hexadecimal(session.checksum)},
                        {"dataset", session.dataset},
                        {"command", session.command},
                        {"program", session.program},
                        {"started", session.started}});
  json["sessions"] = sessions;
  return json;
}

std::string Names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "-" : text;
}

int PrintInfo(const MapCommandArguments& a, const Console& console) {
  const MapStore store(a.file);
  const MapInfo info = store.Describe();
  const MapResults results = store.Results();
  if (a.json) {
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    std::printf("%s\n", JsonOf(info, results).dump(2, ' ', false, replace).c_str());
    return 0;
  }
  const MapCounts counts = CountsOf(results);
  console.Say(a.file + ": " + Number("%.2f", static_cast<double>(info.file_bytes) / 1e6) + " MB, " +
              Number("%.2f", counts.path_m / 1e3) + " km, " + std::to_string(counts.landmarks) +
              " landmarks, " + std::to_string(counts.loops) + " loops accepted");
  std::vector<std::vector<std::string>> rows = {
      {"session", "state", "frames", "loops to earlier", "common map with", "started", "dataset"}};
  for (const SessionInfo& session : info.sessions)
    rows.push_back({session.name, session.ended ? "ended" : "open", std::to_string(session.frames),
                    std::to_string(LoopsToEarlierSessions(results, session)),
                    Names(JoinedSessions(info, results, session)), session.started,
                    session.dataset});
  console.Say(AlignedTable(rows));
  return 0;
}

int Verify(const MapCommandArguments& a, const Console& console) {
  const std::vector<std::string> problems = MapStore(a.file).Verify();
  if (a.json) {
    const nlohmann::ordered_json json = {{"ok", problems.empty()}, {"problems", problems}};
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    std::printf("%s\n", json.dump(2, ' ', false, replace).c_str());
  }
  for (const std::string& problem : problems)
    if (!a.json) console.Say(problem);
  if (!problems.empty())
    throw Error(ErrorKind::kBadInput,
                a.file + ": is damaged: " + problems.front() +
                    "; restore a copy, or build the map again from its drives");
  if (!a.json) console.Say(a.file + ": ok");
  return 0;
}

int Export(const MapCommandArguments& a, const Console& console) {
  const std::optional<GeoOrigin> origin = a.geo.Origin();
  const MapStore store(a.file);
  const MapInfo info = store.Describe();
  const MapResults results = store.Results();
  const std::vector<std::string> paths = ExportMap(info, results, a.out, origin);
  for (const std::string& path : paths)
    if (!a.json) console.Say("wrote " + path);
  const MapCounts counts = CountsOf(results);
  if (a.json)
    PrintWritten({{"map", a.file},
                  {"sessions", info.sessions.size()},
                  {"landmarks", counts.landmarks},
                  {"loops_accepted", counts.loops}},
                 paths);
  return 0;
}

int Compact(const MapCommandArguments& a, const Console& console) {
  CompactMap(a.file);
  console.Say(a.file + ": " +
              Number("%.2f", static_cast<double>(MapStore(a.file).Describe().file_bytes) / 1e6) +
              " MB");
  return 0;
}

// Refines as the end of a run does.
int End(const MapCommandArguments& a, const Console& console) {
  MapperContext context;
  {
    const MapInfo info = MapStore(a.file).Describe();
    context.gravity = GravityFrame::FromUp(info.up_axis);
    context.labels = info.labels;
    context.camera = info.camera;
  }
  MapSession session = MapSession::Resume(a.file, context);
  if (session.options().refine.enabled) session.Refine();
  session.End();
  console.Say(a.file + ": session '" + session.info().name + "' ended with " +
              std::to_string(session.info().frames) + " frames");
  return 0;
}

int Diff(const MapCommandArguments& a, const Console& console) {
  PrintMapDiff(a.file, a.diff, console);
  return 0;
}

int Merge(const MapCommandArguments& a, const Console& console) {
  return MergeInto(a.file, a.merge, console);
}

using MapFunction = int (*)(const MapCommandArguments&, const Console&);
struct MapSubcommand {
  const char *name, *meaning;
  MapFunction run;
  std::string examples;
};
const MapSubcommand kMapSubcommands[] = {
    {"info", "what a map holds", PrintInfo,
     Examples({"map info site.db", "map info site.db --json"})},
    {"verify", "read all of a map and compare it with its checksums", Verify,
     Examples({"map verify site.db", "map verify site.db --json"})},
    {"export", "write the results as the files of a run folder", Export,
     Examples({"map export site.db --out site --json",
               "map export site.db --out site --origin 49.01,8.43 --heading 120"})},
    {"diff", "what has changed between two sessions", Diff,
     Examples(
         {"map diff site.db", "map diff site.db --from monday --to tuesday --csv changes.csv"})},
    {"merge", "add the sessions of other maps", Merge,
     Examples({"map merge site.db robot2.db",
               "map merge monday.db tuesday.db wednesday.db --out week.db --rename"})},
    {"compact", "update an older schema and return unused space to the disk", Compact,
     Examples({"map compact site.db"})},
    {"end", "end a session that was interrupted, with the frames that it has", End,
     Examples({"map end site.db"})}};

}  // namespace

Command AddMapCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand("map", "look at a map in a file, check and export it");
  command->require_subcommand(1);
  command->footer(Examples({"map info site.db", "map diff site.db --json"}));
  const auto arguments = std::make_shared<MapCommandArguments>();
  for (const MapSubcommand& row : kMapSubcommands) {
    CLI::App* one = command->add_subcommand(row.name, row.meaning);
    one->add_option("MAP", arguments->file, "file of the map")->required();
    one->footer(row.examples);
    one->add_flag("-q,--quiet", console.quiet, "print errors only");
    if (row.run == Export) {
      one->add_option("--out", arguments->out, "folder to write")->required();
      arguments->geo.AddTo(*one, "writes map.geojson, too");
    }
    if (row.run == Diff) {
      MapDiffArguments& diff = arguments->diff;
      one->add_option("--from", diff.from,
                      "name of the earlier session; default: the last before --to that has seen "
                      "common ground");
      one->add_option("--to", diff.to, "name of the later session; default: the last one");
      one->add_option("--csv", diff.csv, "file to write with a row per change");
      one->add_flag("--json", diff.json, "print JSON");
    }
    if (row.run == Merge) arguments->merge.AddTo(*one);
    if (row.run == PrintInfo || row.run == Verify || row.run == Export)
      one->add_flag("--json", arguments->json, "print JSON");
  }
  return [command, arguments, &console] {
    console.InstallLog();
    const std::string name = command->get_subcommands().front()->get_name();
    for (const MapSubcommand& row : kMapSubcommands)
      if (row.name == name) return row.run(*arguments, console);
    return 0;
  };
}

}  // namespace sslcd::apps
