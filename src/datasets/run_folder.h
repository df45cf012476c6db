// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/map_json.h"
#include "formats/metrics_json.h"
#include "formats/run_json.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"
#include "sslcd/core/pose_graph.h"
#include "sslcd/core/timing.h"

namespace sslcd {

/// All outputs of a run.
struct RunOutputs {
  Trajectory trajectory, odometry;
  /// the true poses that the run was compared with; empty: there were none
  Trajectory groundtruth;
  MapFile map;
  PoseGraph graph;
  std::vector<LoopClosure> loops;
  TimingTable timing;
  Metrics metrics;
  std::string config_yaml;
  RunRecord record;  ///< without the list of files
};

/// Returns the paths of trajectory_{tum,kitti}.txt, odometry_{tum,kitti}.txt, groundtruth_tum.txt,
/// map.json, map.ply, graph.g2o, loops.csv, timing.json, metrics.json, config.yaml and run.json in
/// the folder.
std::vector<std::string> RunFolderPaths(const std::string& folder);

/// Writes these files, all or none, run.json last, and creates the folder if necessary. Returns
/// their paths. Throws Error(kOutput).
std::vector<std::string> WriteRunFolder(const std::string& folder, const RunOutputs& outputs);

/// Reads run.json and compares the files with it. Returns nothing if there is no run.json, as in
/// folders that earlier versions have written. Throws Error(kBadInput), with the file, if one is
/// missing or is that of another run, and as RefuseUnfinished() does.
std::optional<RunRecord> CheckRunFolder(const std::string& folder);

}  // namespace sslcd
