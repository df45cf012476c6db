// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose_graph.h"
#include "sslcd/core/timing.h"
#include "sslcd/core/trajectory.h"
#include "sslcd/io/map_json.h"

namespace sslcd {

/// Name -> value in the order they are to be read; a value that is not there becomes null.
using Metrics = std::vector<std::pair<std::string, std::optional<double>>>;

/// Everything a run leaves behind.
struct RunOutputs {
  Trajectory trajectory, odometry;
  MapFile map;
  PoseGraph graph;
  std::vector<LoopClosure> loops;
  TimingTable timing;
  Metrics metrics;
  std::string config_yaml;
};

/// "t x y z qx qy qz qw" a row, single blanks, qw >= 0: TUM's format, as evo reads it.
std::string TumText(const Trajectory& trajectory);
/// The 3x4 matrix of each pose in one row: KITTI's format.
std::string KittiText(const Trajectory& trajectory);
/// VERTEX_SE3:QUAT, FIX and EDGE_SE3:QUAT rows; information in the order [translation, rotation],
/// upper triangle.
std::string G2oText(const PoseGraph& graph);
/// One row per attempt to close a loop, accepted or not; see docs/formats.md.
std::string LoopsCsv(const std::vector<LoopClosure>& loops);
/// Cuboids of the confirmed objects (faces) and camera positions (points): ASCII PLY.
std::string PlyText(const MapFile& map, const Trajectory& trajectory);
std::string TimingJson(const TimingTable& timing);
std::string MetricsJson(const Metrics& metrics);

/// trajectory_{tum,kitti}.txt, odometry_{tum,kitti}.txt, map.json, map.ply, graph.g2o, loops.csv,
/// timing.json, metrics.json and config.yaml in that folder.
std::vector<std::string> RunFolderPaths(const std::string& folder);

/// Writes these files, all or none, into a folder that is made if need be. Returns their paths.
/// Throws Error(kOutput).
std::vector<std::string> WriteRunFolder(const std::string& folder, const RunOutputs& outputs);

}  // namespace sslcd
