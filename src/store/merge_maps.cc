// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/store/merge_maps.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "sslcd/core/error.h"
#include "sslcd/core/log.h"
#include "sslcd/store/map_session.h"
#include "store/map_copy.h"
#include "store/merge_check.h"
#include "store/merge_source.h"
#include "store/schema.h"
#include "store/write_lock.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

// Counts frames, and tells the host.
class Counter {
 public:
  Counter(const std::function<bool(int, int)>& tell, int total) : tell_(tell), total_(total) {}
  bool Next() { return !tell_ || tell_(++done_, total_); }

 private:
  const std::function<bool(int, int)>& tell_;
  int done_ = 0, total_ = 0;
};

// Gives the inputs of one session to a session of another map. False: stopped.
bool Repeat(const MergeSource& source, const SessionInfo& of, bool refine, MapSession& session,
            Counter& counter) {
  bool first = true;
  for (const StoredInput& input : source.inputs) {
    if (input.session != of.id) continue;
    const bool begins = std::exchange(first, false);
    switch (input.kind) {
      case InputKind::kSequence:
        if (!begins) session.StartSequence();  // MapSession has begun the first one
        break;
      case InputKind::kRefinement:
        if (refine) session.Refine(RefinementOf(input.content).when);
        break;
      case InputKind::kFrame:
        session.AddFrame(FrameIn(input, source.path));
        if (!counter.Next()) return false;
    }
  }
  return true;
}

// Adds the sessions that are planned to the map at `path`. False: stopped.
bool AddSessions(const std::string& path, const std::vector<MergeSource>& sources,
                 const std::vector<PlannedSession>& plan, bool refine_once, Counter& counter) {
  std::optional<MapSession> session;
  for (const PlannedSession& planned : plan) {
    const MergeSource& source = sources[planned.source];
    const SessionInfo& of = planned.session;
    const SessionRequest request{planned.name, of.dataset, of.command, of.program};
    const MapperContext context = ContextOf(source, of);
    if (session)
      session->BeginNext(request, context);
    else
      session = MapSession::Begin(path, request, context, std::nullopt);
    if (!Repeat(source, of, !refine_once, *session, counter)) return false;
  }
  if (refine_once) session->Refine(Refinement::kAtEnd);
  session->End();
  return true;
}

void CheckFiles(const MergeRequest& request) {
  if (request.from.empty())
    throw Error(ErrorKind::kUsage, "no map to take sessions from; name at least two maps");
  std::error_code none;
  for (const std::string& from : request.from)
    if (fs::equivalent(from, request.into, none))
      throw Error(ErrorKind::kUsage, from + ": a map cannot be merged with itself; name another");
  const std::string copy =
      WorkingCopy::PathBeside(request.out.empty() ? request.into : request.out);
  std::vector<std::string> maps = request.from;
  maps.push_back(request.into);
  for (const std::string& map : maps)
    if (fs::equivalent(map, copy, none))
      throw Error(ErrorKind::kUsage, map +
                                         ": the working copy of this merge gets this name; rename "
                                         "the map, or choose another file for the merged one");
  if (!request.out.empty() && fs::exists(fs::symlink_status(request.out, none)))
    throw Error(ErrorKind::kUsage, request.out + ": exists; name a new file, or remove it");
}

MergeReport ReportOf(const std::vector<MergeSource>& sources,
                     const std::vector<PlannedSession>& plan) {
  MergeReport report;
  for (const PlannedSession& planned : plan)
    report.added.push_back(
        {sources[planned.source].path, planned.session.name, planned.name, planned.session.frames});
  for (const MergeSource& source : sources)
    for (const SessionInfo& session : source.info.sessions)
      if (!session.ended) report.left_out.push_back(source.path + ": " + session.name);
  return report;
}

}  // namespace

MergeReport MergeMaps(const MergeRequest& request) {
  CheckFiles(request);
  const bool in_place = request.out.empty();
  const std::string& target = in_place ? request.into : request.out;
  OpenMap(request.into, Database::Access::kRead);  // before a lock is made beside nothing
  const FileLock lock = LockMap(target);
  std::vector<MergeSource> sources;
  for (const std::string& path : request.from) sources.push_back(ReadMergeSource(path));
  const std::vector<PlannedSession> plan =
      PlanMerge(ReadMergeSource(request.into), sources, request.rename);
  MergeReport report = ReportOf(sources, plan);
  int total = 0;
  for (const MergedSession& session : report.added) total += session.frames;
  Counter counter(request.progress, total);
  try {
    WorkingCopy copy(request.into, target);
    if (!AddSessions(copy.path(), sources, plan, request.refine_once, counter)) {
      report.stopped = true;
      return report;
    }
    if (in_place)
      copy.WriteInto(target);
    else
      copy.MoveTo(target);
  } catch (const Error& error) {
    throw Error(error.kind(),
                target + " was not " + (in_place ? "changed" : "made") + ": " + error.what());
  }
  return report;
}

}  // namespace sslcd
