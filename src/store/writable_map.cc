// SPDX-License-Identifier: BSD-3-Clause
#include "store/writable_map.h"

#include "sslcd/core/error.h"
#include "store/checksums.h"
#include "store/frame_bytes.h"
#include "store/result_tables.h"
#include "store/schema.h"
#include "store/site.h"

namespace sslcd {
namespace {

[[noreturn]] void RefuseDamaged(const std::string& path, const std::string& problem) {
  throw Error(ErrorKind::kBadInput, path + ": is damaged: " + problem +
                                        "; restore a copy, or build the map again from its drives");
}

}  // namespace

WritableMap::WritableMap(const std::string& path, Database::Access access)
    : lock(LockMap(path)), database(OpenMap(path, access)), info(ReadInfo(database)) {
  is_new = info.sessions.empty();
  if (is_new) return;
  std::vector<std::string> problems = FileProblems(database, false);
  if (!problems.empty()) RefuseDamaged(path, problems.front());
  problems = ReadInputs(database, info.sessions, [&](const StoredInput& input) {
    has_views |= input.kind == InputKind::kRefinement && !RefinementOf(input.content).views.empty();
  });
  if (!problems.empty()) RefuseDamaged(path, problems.front());
}

void StoreBatch(WritableMap& map, const StoredBatch& batch) {
  Database& database = map.database;
  Transaction transaction(database, Transaction::Kind::kWrite);
  if (database.Integer("SELECT count(*) FROM site") == 0) WriteNewSite(database, map.info);
  for (const auto& [name, label] : batch.labels.entries()) WriteLabel(database, name, label);
  for (const CueRow& row : kCueRows)
    if (const int length = batch.vector_length[row.cue]; length > 0)
      WriteVectorLength(database, row.cue, length);
  if (batch.session) WriteSession(database, *batch.session);
  if (batch.inputs) AppendInputs(database, *batch.inputs);
  UpdateChecksums(database, kSiteTables);
  if (batch.results) {
    MapResults results = ResultsOf(*batch.results, map.info.sessions);
    results.inputs = database.Integer("SELECT count(*) FROM input");
    WriteResults(database, results, map.info.sessions);
  } else if (map.is_new) {
    UpdateChecksums(database, kResultTables);
  }
  transaction.Commit();
  map.is_new = false;
}

MapResults ResultsOf(const Mapper& mapper, const std::vector<SessionInfo>& sessions) {
  MapResults results;
  results.graph = mapper.Graph();
  const Trajectory trajectory = mapper.CameraTrajectory();
  std::size_t next = 0;
  for (const SessionInfo& session : sessions) {
    SessionPath path;
    path.session = session.id;
    for (; next < trajectory.size() && session.last_frame &&
           results.graph.vertices[next].id <= *session.last_frame;
         ++next) {
      path.frames.push_back(results.graph.vertices[next].id);
      path.trajectory.stamps.push_back(trajectory.stamps[next]);
      path.trajectory.poses.push_back(trajectory.poses[next]);
    }
    if (!path.frames.empty()) results.paths.push_back(std::move(path));
  }
  results.parts = mapper.Parts();
  results.objects = mapper.Objects();
  results.loops = WithoutEarly(mapper.LoopClosures());
  results.scale = mapper.scale();
  results.noise_scale = mapper.noise_scale();
  return results;
}

}  // namespace sslcd
