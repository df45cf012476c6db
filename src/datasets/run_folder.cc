// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/run_folder.h"

#include <filesystem>

#include "formats/atomic_file.h"
#include "formats/g2o.h"
#include "formats/loops_csv.h"
#include "formats/ply.h"
#include "sslcd/formats/poses.h"

namespace sslcd {
namespace {

/// Paths and contents.
std::vector<std::pair<std::string, std::string>> FilesOf(const RunOutputs& outputs,
                                                         const std::string& folder) {
  const std::filesystem::path root = folder;
  return {{root / "trajectory_tum.txt", TumText(outputs.trajectory)},
          {root / "trajectory_kitti.txt", KittiText(outputs.trajectory)},
          {root / "odometry_tum.txt", TumText(outputs.odometry)},
          {root / "odometry_kitti.txt", KittiText(outputs.odometry)},
          {root / "map.json", MapJson(outputs.map)},
          {root / "map.ply", PlyText(outputs.map, outputs.trajectory)},
          {root / "graph.g2o", G2oText(outputs.graph)},
          {root / "loops.csv", LoopsCsv(outputs.loops)},
          {root / "timing.json", TimingJson(outputs.timing)},
          {root / "metrics.json", MetricsJson(outputs.metrics)},
          {root / "config.yaml", outputs.config_yaml}};
}

}  // namespace

std::vector<std::string> RunFolderPaths(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& [path, content] : FilesOf(RunOutputs(), folder)) paths.push_back(path);
  return paths;
}

std::vector<std::string> WriteRunFolder(const std::string& folder, const RunOutputs& outputs) {
  MakeWritableFolder(folder);
  WriteFilesAtomically(FilesOf(outputs, folder));
  return RunFolderPaths(folder);
}

}  // namespace sslcd
