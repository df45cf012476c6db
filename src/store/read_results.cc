// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "sslcd/core/error.h"
#include "store/result_rows.h"
#include "store/result_tables.h"

namespace sslcd {
namespace {

// The enumerator of this name; a table's CHECK allows no other.
template <class E>
E Named(const std::string& name, std::initializer_list<E> all) {
  for (const E value : all)
    if (name == ToString(value)) return value;
  throw Error(ErrorKind::kBadInput, "a map has the unknown value '" + name + "'");
}

void ReadPaths(Database& database, MapResults& results) {
  Statement row(database,
                "SELECT frame, session, stamp, qx,qy,qz,qw, x,y,z FROM pose "
                "ORDER BY frame");
  while (row.Step()) {
    if (results.paths.empty() || results.paths.back().session != row.Int(1)) {
      results.paths.emplace_back();
      results.paths.back().session = row.Int(1);
    }
    SessionPath& path = results.paths.back();
    path.frames.push_back(row.Int(0));
    path.trajectory.stamps.push_back(row.Finite(2));
    path.trajectory.poses.push_back(PoseAt(row, 3));
    results.graph.vertices.push_back(
        {row.Int(0), path.trajectory.poses.back(), results.graph.vertices.empty()});
  }
}

void ReadLandmarks(Database& database, MapResults& results) {
  std::map<int, std::vector<Observation>> seen;
  Statement sighting(database,
                     "SELECT landmark, frame, detection FROM sighting ORDER BY landmark, position");
  while (sighting.Step()) seen[sighting.Int(0)].push_back({sighting.Int(1), sighting.Int(2)});
  Statement row(database,
                "SELECT id, label, state, qx,qy,qz,qw, x,y,z, length, width, height "
                "FROM landmark ORDER BY id");
  while (row.Step()) {
    MapObject object;
    object.id.value = row.Int(0);
    object.label = row.Text(1);
    object.state = Named(row.Text(2), {LandmarkState::kTentative, LandmarkState::kConfirmed,
                                       LandmarkState::kDynamic, LandmarkState::kStale});
    object.T_world_object = PoseAt(row, 3);
    object.dims = Vec3(row.Finite(10), row.Finite(11), row.Finite(12));
    object.observations = std::move(seen[object.id.value]);
    results.objects.push_back(std::move(object));
  }
}

void ReadLoops(Database& database, MapResults& results) {
  std::map<int, std::vector<std::pair<LandmarkId, LandmarkId>>> pairs;
  Statement pair(database, "SELECT loop, local, global FROM loop_pair ORDER BY loop, position");
  while (pair.Step()) pairs[pair.Int(0)].push_back({{pair.Int(1)}, {pair.Int(2)}});
  Statement row(database,
                "SELECT id, newest_frame, query_frame, match_frame, decision, reason, score, "
                "second_score, probability, qx,qy,qz,qw, x,y,z, covariance, by_views, "
                "viewpoint_change FROM loop ORDER BY position");
  while (row.Step()) {
    LoopClosure loop;
    loop.id = row.Int(0);
    loop.newest_frame = row.Int(1);
    loop.query_frame = row.Int(2);
    loop.match_frame = row.Int(3);
    loop.decision = Named(row.Text(4),
                          {LoopDecision::kNone, LoopDecision::kAmbiguous, LoopDecision::kAccepted});
    loop.reason = row.Text(5);
    loop.score = row.Real(6);
    loop.second_score = row.Real(7);
    if (!row.IsNull(8)) loop.probability = row.Real(8);
    loop.T_match_query = PoseAt(row, 9);
    loop.covariance = MatrixOf(row.Blob(16));
    loop.by_views = row.Int(17) != 0;
    loop.viewpoint_change_rad = row.Real(18);
    loop.pairs = std::move(pairs[loop.id]);
    results.loops.push_back(std::move(loop));
  }
}

}  // namespace

MapResults ReadResults(Database& database) {
  MapResults results;
  Statement row(database,
                "SELECT inputs, scale, noise_radial, noise_lateral, noise_vertical, "
                "noise_yaw FROM result");
  if (!row.Step()) return results;
  results.inputs = row.Integer(0);
  results.scale = row.Finite(1);
  results.noise_scale = {row.Finite(2), row.Finite(3), row.Finite(4), row.Finite(5)};
  ReadPaths(database, results);
  Statement part(database, "SELECT first_frame, sequence, joined_with FROM part ORDER BY id");
  while (part.Step()) results.parts.push_back({part.Int(0), part.Int(1), part.Int(2)});
  ReadLandmarks(database, results);
  ReadLoops(database, results);
  Statement edge(database,
                 "SELECT from_frame, to_frame, loop, qx,qy,qz,qw, x,y,z, information "
                 "FROM edge ORDER BY id");
  while (edge.Step())
    results.graph.edges.push_back(
        {edge.Int(0), edge.Int(1), PoseAt(edge, 3), MatrixOf(edge.Blob(10)), edge.Int(2) != 0});
  return results;
}

}  // namespace sslcd
