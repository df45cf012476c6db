// SPDX-License-Identifier: BSD-3-Clause
#include "map_export/export_map.h"

#include <filesystem>
#include <utility>

#include "formats/atomic_file.h"
#include "formats/file_lock.h"
#include "formats/file_set.h"
#include "formats/files.h"
#include "formats/g2o.h"
#include "formats/loops_csv.h"
#include "formats/map_json.h"
#include "formats/ply.h"
#include "sslcd/formats/poses.h"

namespace sslcd {
namespace {

using PathsAndTexts = std::vector<std::pair<std::string, std::string>>;

void AddPath(const SessionPath& path, const std::filesystem::path& folder, PathsAndTexts& files) {
  MakeWritableFolder(folder.string());
  files.insert(files.end(), {{folder / "trajectory_tum.txt", TumText(path.trajectory)},
                             {folder / "trajectory_kitti.txt", KittiText(path.trajectory)},
                             {folder / "odometry_tum.txt", TumText(path.odometry)},
                             {folder / "odometry_kitti.txt", KittiText(path.odometry)}});
}

}  // namespace

std::vector<std::string> ExportMap(const MapInfo& info, const MapResults& results,
                                   const std::string& folder,
                                   const std::optional<GeoOrigin>& origin) {
  const std::filesystem::path root = folder;
  const FileLock lock = LockFolder(folder);
  const MapFile map{info.up_axis, results.objects};
  Trajectory all;
  PathsAndTexts files;
  for (const SessionPath& path : results.paths) {
    for (const SessionInfo& session : info.sessions)
      if (session.id == path.session) AddPath(path, root / session.name, files);
    const Trajectory& trajectory = path.trajectory;
    all.stamps.insert(all.stamps.end(), trajectory.stamps.begin(), trajectory.stamps.end());
    all.poses.insert(all.poses.end(), trajectory.poses.begin(), trajectory.poses.end());
  }
  files.insert(files.end(), {{root / "map.json", MapJson(map)},
                             {root / "map.ply", PlyText(map, all)},
                             {root / "graph.g2o", G2oText(results.graph)},
                             {root / "loops.csv", LoopsCsv(results.loops)},
                             {root / "config.yaml", info.config}});
  std::vector<std::string> removed;
  if (origin)
    files.emplace_back(root / "map.geojson", MapGeoJson(info, results, *origin));
  else if (!IfFile((root / "map.json").string()).empty())  // that of an earlier export
    removed.push_back((root / "map.geojson").string());
  std::vector<std::string> paths;
  for (const auto& [path, text] : files) paths.push_back(path);
  WriteFileSet({folder, "map", std::move(files), std::move(removed)});
  return paths;
}

}  // namespace sslcd
