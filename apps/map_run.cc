// SPDX-License-Identifier: BSD-3-Clause
#include "map_run.h"

#include <filesystem>

#include "core/command_line.h"
#include "pipeline/frame_colours.h"
#include "sslcd/config/config.h"
#include "sslcd/core/error.h"
#include "sslcd/store/map_session.h"
#include "store/session_view.h"

namespace sslcd::apps {
namespace {

MapSession Open(const MapArguments& map, const MapDrive& drive, const MapperContext& context,
                const Options& options) {
  const std::string name = map.session.empty() ? drive.name : map.session;
  if (!map.resume) {
    const std::string folder = std::filesystem::absolute(drive.folder).lexically_normal();
    return MapSession::Begin(map.file, {name, folder, CommandLine(CommandWords()), VersionText()},
                             context, options);
  }
  MapSession session = MapSession::Resume(map.file, context);
  if (session.info().name != name)
    throw Error(ErrorKind::kUsage, map.file + ": the session to go on with is '" +
                                       session.info().name + "', not '" + name + "'");
  return session;
}

// "12" in the session that goes on, "12 of 'monday'" in another one.
std::string FrameName(const std::vector<SessionInfo>& sessions, const SessionInfo& own, int frame) {
  const SessionInfo* of = &own;
  for (const SessionInfo& session : sessions)
    if (frame < own.frame_offset && frame >= session.frame_offset) of = &session;
  const std::string number = std::to_string(frame - of->frame_offset);
  return of == &own ? number : number + " of '" + of->name + "'";
}

void SetResults(const MapArguments& map, const SessionInfo& info, RunResult& result) {
  MapResults session = ResultsOfSession(MapStore(map.file).Results(), info);
  if (!session.paths.empty()) {
    result.frames = session.paths[0].frames;
    result.trajectory = session.paths[0].trajectory;
    result.odometry = session.paths[0].odometry;
  }
  result.objects = std::move(session.objects);
  result.loops = std::move(session.loops);
  result.graph = std::move(session.graph);
  result.scale = session.scale;
  result.noise_scale = session.noise_scale;
}

}  // namespace

void UseOptionsOfMap(const MapArguments& map, const ConfigArguments& config,
                     Configuration& configuration) {
  if (!map.given() || !HasMap(map.file)) return;
  const MapInfo info = MapStore(map.file).Describe();
  Options options;
  LoadConfigText(info.config, map.file,
                 [&](FieldVisitor& visitor) { DescribeFields(visitor, options); });
  // a mode sets all options, so it has to be that of the map
  if (config.mode.empty())
    configuration.options =
        config.LoadOver(configuration.mode, [&](Configuration& c) { c.options = options; }).options;
}

RunResult RunInMap(const MapArguments& map, const MapDrive& drive, const MapperContext& context,
                   const Options& options, const RunHooks& hooks) {
  std::vector<SessionInfo> sessions;
  if (HasMap(map.file)) sessions = MapStore(map.file).Describe().sessions;
  MapSession session = Open(map, drive, context, options);
  drive.loops.Begin(session.mapper().LoopClosures(), [sessions, own = session.info()](int frame) {
    return FrameName(sessions, own, frame);
  });
  RunResult result;
  int done = 0;
  while (true) {
    result.stopped = hooks.stop();
    std::optional<Frame> frame = result.stopped ? std::nullopt : drive.next();
    if (!frame) break;
    if (hooks.with_image && LacksColour(*frame))
      result.images_failed += AddColours(*frame, options.colour, hooks) ? 0 : 1;
    if (!session.IsStored(*frame)) hooks.loops(session.AddFrame(*frame).changes.loops);
    hooks.progress(++done, drive.total);
  }
  if (result.stopped || drive.failed()) {
    result.stopped = true;
    session.Save();
    return result;
  }
  if (options.refine.enabled) result.refinement = session.Refine();
  hooks.loops(session.mapper().TakeChanges().loops);
  if (hooks.stop()) {  // then not all views are aligned; what is not stored comes again
    result.stopped = true;
    return result;
  }
  session.End();
  result.filter = session.filter();
  Mapper& mapper = session.mapper();
  result.loop_search = mapper.SummariseLoopSearch();
  result.views_tied = static_cast<int>(mapper.view_ties().size());
  result.improvement = mapper.improvement();
  result.timing = mapper.timing();
  SetResults(map, session.info(), result);
  return result;
}

std::string MapLine(const MapArguments& map) {
  const MapStore store(map.file);
  const MapInfo info = store.Describe();
  const SessionInfo& session = info.sessions.back();
  std::string line = map.file + ": session '" + session.name + "', " +
                     std::to_string(session.frames) + " frames stored";
  if (!session.ended) return line;
  const MapResults results = store.Results();
  int landmarks = 0;
  for (const MapObject& object : results.objects)
    landmarks += object.state == LandmarkState::kConfirmed ? 1 : 0;
  return line + ", " + std::to_string(LoopsToEarlierSessions(results, session)) +
         " loops to earlier sessions; " + std::to_string(info.sessions.size()) + " sessions with " +
         std::to_string(landmarks) + " landmarks";
}

}  // namespace sslcd::apps
