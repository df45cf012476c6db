// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/run_folder.h"

#include <filesystem>

#include "formats/atomic_file.h"
#include "formats/file_set.h"
#include "formats/files.h"
#include "formats/g2o.h"
#include "formats/loops_csv.h"
#include "formats/ply.h"
#include "sslcd/core/error.h"
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
          {root / "groundtruth_tum.txt", TumText(outputs.groundtruth)},
          {root / "map.json", MapJson(outputs.map)},
          {root / "map.ply", PlyText(outputs.map, outputs.trajectory)},
          {root / "graph.g2o", G2oText(outputs.graph)},
          {root / "loops.csv", LoopsCsv(outputs.loops)},
          {root / "timing.json", TimingJson(outputs.timing)},
          {root / "metrics.json", MetricsJson(outputs.metrics)},
          {root / "config.yaml", outputs.config_yaml}};
}

constexpr const char* kRecord = "run.json";

std::string RecordPath(const std::string& folder) {
  return (std::filesystem::path(folder) / kRecord).string();
}

}  // namespace

std::vector<std::string> RunFolderPaths(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& [path, content] : FilesOf(RunOutputs(), folder)) paths.push_back(path);
  paths.push_back(RecordPath(folder));
  return paths;
}

std::vector<std::string> WriteRunFolder(const std::string& folder, const RunOutputs& outputs) {
  MakeWritableFolder(folder);
  std::vector<std::pair<std::string, std::string>> files = FilesOf(outputs, folder);
  RunRecord record = outputs.record;
  for (const auto& [path, content] : files)
    record.files.push_back(RecordOf(std::filesystem::path(path).filename().string(), content));
  files.emplace_back(RecordPath(folder), RunJson(record));
  WriteFilesAtomically(files);
  return RunFolderPaths(folder);
}

std::optional<RunRecord> CheckRunFolder(const std::string& folder) {
  const std::string record_path = RecordPath(folder);
  RefuseUnfinished(folder);
  if (IfFile(record_path).empty()) return std::nullopt;
  RunRecord record = ReadRunJson(record_path);
  for (const FileRecord& expected : record.files) {
    const std::string path = (std::filesystem::path(folder) / expected.name).string();
    const FileRecord found = RecordFile(path);
    if (found.bytes == expected.bytes && found.sha256 == expected.sha256) continue;
    throw Error(ErrorKind::kBadInput,
                path + ": is not the file that " + record_path +
                    " lists: it was changed, or is of another run that was stopped while it wrote; "
                    "repeat the run");
  }
  return record;
}

}  // namespace sslcd
