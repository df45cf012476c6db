// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/io/run_folder.h"

#include <algorithm>
#include <cmath>

#include "io/number_text.h"
#include "sslcd/io/atomic_file.h"
#include "sslcd/io/csv.h"

namespace sslcd {
namespace {

// Translation and quaternion with qw >= 0, blank-separated: "x y z qx qy qz qw".
std::string PoseText(const Pose& T) {
  const auto& q = T.unit_quaternion();
  const double sign = q.w() < 0 ? -1. : 1.;
  std::string text;
  for (int i = 0; i < 3; ++i) text += FixedNumber(T.translation()[i], 9) + " ";
  for (const double component : {q.x(), q.y(), q.z()})
    text += FixedNumber(sign * component, 9) + " ";
  return text + FixedNumber(sign * q.w(), 9);
}

/// Paths and contents.
std::vector<std::pair<std::string, std::string>> FilesOf(const RunOutputs& outputs,
                                                         const std::string& folder) {
  return {{folder + "/trajectory_tum.txt", TumText(outputs.trajectory)},
          {folder + "/trajectory_kitti.txt", KittiText(outputs.trajectory)},
          {folder + "/odometry_tum.txt", TumText(outputs.odometry)},
          {folder + "/odometry_kitti.txt", KittiText(outputs.odometry)},
          {folder + "/map.json", MapJson(outputs.map)},
          {folder + "/map.ply", PlyText(outputs.map, outputs.trajectory)},
          {folder + "/graph.g2o", G2oText(outputs.graph)},
          {folder + "/loops.csv", LoopsCsv(outputs.loops)},
          {folder + "/timing.json", TimingJson(outputs.timing)},
          {folder + "/metrics.json", MetricsJson(outputs.metrics)},
          {folder + "/config.yaml", outputs.config_yaml}};
}

}  // namespace

std::string TumText(const Trajectory& trajectory) {
  std::string text;
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    text += FixedNumber(trajectory.stamps[i], 9) + " " + PoseText(trajectory.poses[i]) + "\n";
  return text;
}

std::string KittiText(const Trajectory& trajectory) {
  std::string text;
  for (const Pose& T : trajectory.poses) {
    const auto M = T.matrix3x4();
    for (int i = 0; i < 12; ++i) text += FixedNumber(M(i / 4, i % 4), 9) + (i < 11 ? " " : "\n");
  }
  return text;
}

std::string G2oText(const PoseGraph& graph) {
  std::string text;
  for (const auto& vertex : graph.vertices) {
    text += "VERTEX_SE3:QUAT " + std::to_string(vertex.id) + " " + PoseText(vertex.T_world_vertex) +
            "\n";
    if (vertex.fixed) text += "FIX " + std::to_string(vertex.id) + "\n";
  }
  for (const auto& edge : graph.edges) {
    text += "EDGE_SE3:QUAT " + std::to_string(edge.from) + " " + std::to_string(edge.to) + " " +
            PoseText(edge.T_from_to);
    for (int row = 0; row < 6; ++row)
      for (int column = row; column < 6; ++column)
        text += " " + ShortestNumber(edge.information(row, column));
    text += "\n";
  }
  return text;
}

std::string PlyText(const MapFile& map, const Trajectory& trajectory) {
  // Corner i of a cuboid: bit 0 front, bit 1 left, bit 2 top.
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::string vertices, faces;
  int count = 0, face_count = 0;
  for (const MapObject& object : map.objects) {
    if (object.state != LandmarkState::kConfirmed) continue;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
      const Vec3 p = object.T_world_object * Vec3(corner.cwiseProduct(object.dims));
      for (int axis = 0; axis < 3; ++axis) vertices += FixedNumber(p[axis], 4) + " ";
      vertices += "70 130 180\n";
    }
    for (const auto& face : kFaces) {
      faces += "4";
      for (const int corner : face) faces += " " + std::to_string(count + corner);
      faces += "\n";
      ++face_count;
    }
    count += 8;
  }
  for (const Pose& T : trajectory.poses) {
    for (int axis = 0; axis < 3; ++axis) vertices += FixedNumber(T.translation()[axis], 4) + " ";
    vertices += "220 50 47\n";
    ++count;
  }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty "
         "uchar green\n"
         "property uchar blue\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + faces;
}

std::string LoopsCsv(const std::vector<LoopClosure>& loops) {
  constexpr double kDegrees = 180 / M_PI;
  std::string text =
      "query_frame,match_frame,decision,reason,score,second_score,matches,viewpoint_change_deg,"
      "tx,ty,tz,qx,qy,qz,qw,pairs\n";
  for (const LoopClosure& loop : loops) {
    text += std::to_string(loop.query_frame) + "," + std::to_string(loop.match_frame) + "," +
            ToString(loop.decision) + "," + CsvField(loop.reason) + "," +
            FixedNumber(loop.score, 3) + "," + FixedNumber(loop.second_score, 3) + "," +
            std::to_string(loop.pairs.size()) + "," +
            FixedNumber(loop.viewpoint_change_rad * kDegrees, 2);
    std::string pose = PoseText(loop.T_match_query);
    std::replace(pose.begin(), pose.end(), ' ', ',');
    text += "," + pose + ",";
    for (std::size_t i = 0; i < loop.pairs.size(); ++i)
      text += (i > 0 ? ";" : "") + std::to_string(loop.pairs[i].first.value) + ":" +
              std::to_string(loop.pairs[i].second.value);
    text += "\n";
  }
  return text;
}

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
