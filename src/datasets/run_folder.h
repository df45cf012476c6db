// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "formats/map_json.h"
#include "formats/metrics_json.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"
#include "sslcd/core/pose_graph.h"
#include "sslcd/core/timing.h"

namespace sslcd {

/// All outputs of a run.
struct RunOutputs {
  Trajectory trajectory, odometry;
  MapFile map;
  PoseGraph graph;
  std::vector<LoopClosure> loops;
  TimingTable timing;
  Metrics metrics;
  std::string config_yaml;
};

/// Returns the paths of trajectory_{tum,kitti}.txt, odometry_{tum,kitti}.txt, map.json, map.ply,
/// graph.g2o, loops.csv, timing.json, metrics.json and config.yaml in the folder.
std::vector<std::string> RunFolderPaths(const std::string& folder);

/// Writes these files, all or none, and creates the folder if necessary. Returns their paths.
/// Throws Error(kOutput).
std::vector<std::string> WriteRunFolder(const std::string& folder, const RunOutputs& outputs);

}  // namespace sslcd
