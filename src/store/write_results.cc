// SPDX-License-Identifier: BSD-3-Clause
#include "store/appearance.h"
#include "store/checksums.h"
#include "store/result_rows.h"
#include "store/result_tables.h"

namespace sslcd {
namespace {

void WritePaths(Database& database, const std::vector<SessionPath>& paths) {
  Statement pose(database, "INSERT INTO pose VALUES (?, ?, ?, ?,?,?,?, ?,?,?)");
  for (const SessionPath& path : paths)
    for (std::size_t i = 0; i < path.frames.size(); ++i) {
      pose.Bind(path.frames[i]).Bind(path.session).Bind(path.trajectory.stamps[i]);
      BindPose(pose, path.trajectory.poses[i]);
      pose.Run();
    }
}

void WriteParts(Database& database, const std::vector<MapPart>& parts) {
  Statement row(database, "INSERT INTO part VALUES (?, ?, ?, ?)");
  int id = 0;
  for (const MapPart& part : parts)
    row.Bind(id++).Bind(part.first_frame).Bind(part.sequence).Bind(part.joined_with).Run();
}

void WriteLandmarks(Database& database, const std::vector<MapObject>& objects) {
  Statement landmark(database,
                     "INSERT INTO landmark VALUES (?, ?, ?, ?,?,?,?, ?,?,?, ?,?,?, ?, ?, ?)");
  Statement sighting(database, "INSERT INTO sighting VALUES (?, ?, ?, ?)");
  for (const MapObject& object : objects) {
    landmark.Bind(object.id.value).BindText(object.label).BindText(ToString(object.state));
    BindPose(landmark, object.T_world_object);
    for (int i = 0; i < 3; ++i) landmark.Bind(object.dims[i]);
    landmark.Bind(static_cast<int>(object.observations.size()));
    if (object.observations.empty())
      landmark.BindNull().BindNull();
    else
      landmark.Bind(object.observations.front().frame).Bind(object.observations.back().frame);
    landmark.Run();
    int position = 0;
    for (const Observation& seen : object.observations)
      sighting.Bind(object.id.value)
          .Bind(position++)
          .Bind(seen.frame)
          .Bind(seen.detection_row)
          .Run();
  }
}

void WriteLoops(Database& database, const std::vector<LoopClosure>& loops) {
  Statement row(database,
                "INSERT INTO loop VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?,?,?,?, ?,?,?, ?, ?, ?)");
  Statement pair(database, "INSERT INTO loop_pair VALUES (?, ?, ?, ?)");
  int position = 0;
  for (const LoopClosure& loop : loops) {
    row.Bind(loop.id).Bind(position++).Bind(loop.newest_frame).Bind(loop.query_frame);
    row.Bind(loop.match_frame).BindText(ToString(loop.decision)).BindText(loop.reason);
    row.Bind(loop.score).Bind(loop.second_score);
    if (loop.probability)
      row.Bind(*loop.probability);
    else
      row.BindNull();
    BindPose(row, loop.T_match_query);
    row.BindBlob(TriangleBytes(loop.covariance)).Bind(loop.by_views ? 1 : 0);
    row.Bind(loop.viewpoint_change_rad).Run();
    int place = 0;
    for (const auto& [local, global] : loop.pairs)
      pair.Bind(loop.id).Bind(place++).Bind(local.value).Bind(global.value).Run();
  }
}

void WriteEdges(Database& database, const PoseGraph& graph) {
  Statement row(database,
                "INSERT INTO edge (from_frame, to_frame, loop, qx, qy, qz, qw, x, y, z, "
                "information) VALUES (?, ?, ?, ?,?,?,?, ?,?,?, ?)");
  for (const PoseGraph::Edge& edge : graph.edges) {
    row.Bind(edge.from).Bind(edge.to).Bind(edge.loop ? 1 : 0);
    BindPose(row, edge.T_from_to);
    row.BindBlob(TriangleBytes(edge.information)).Run();
  }
}

}  // namespace

void WriteResults(Database& database, const MapResults& results,
                  const std::vector<SessionInfo>& sessions) {
  // those that refer to others first
  for (auto table = kResultTables.rbegin(); table != kResultTables.rend(); ++table)
    database.Execute(std::string("DELETE FROM ") + table->name);
  const NoiseScale& noise = results.noise_scale;
  Statement(database, "INSERT INTO result VALUES (1, ?, ?, ?, ?, ?, ?)")
      .Bind(results.inputs)
      .Bind(results.scale)
      .Bind(noise.radial)
      .Bind(noise.lateral)
      .Bind(noise.vertical)
      .Bind(noise.yaw)
      .Run();
  WritePaths(database, results.paths);
  WriteParts(database, results.parts);
  WriteLandmarks(database, results.objects);
  WriteAppearance(database, results.objects, sessions);
  WriteLoops(database, results.loops);
  WriteEdges(database, results.graph);
  UpdateChecksums(database, kResultTables);
}

}  // namespace sslcd
