// SPDX-License-Identifier: BSD-3-Clause
#include "check/sequence.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "formats/npy.h"

namespace sslcd::check {
namespace {

/// What the row of a detection would hold.
DetectionColumns ColumnsOf(int frame, const Detection& detection) {
  DetectionColumns columns;
  const Vec3& centre = detection.T_cam_object.translation();
  columns.frame = frame;
  columns.rotation_y = -GravityFrame().YawOf(detection.T_cam_object.so3());
  columns.alpha = columns.rotation_y - std::atan2(centre.x(), centre.z());
  columns.score = detection.score;
  columns.box = detection.box.value_or(Box2d{-1, -1, -1, -1});
  return columns;
}

/// With their vectors of appearance.
void AddRowsBeyondEnd(const Dataset& dataset, const DetectionFile& file, Sequence& sequence) {
  const std::size_t first = sequence.rows.size();
  for (const auto& [frame, detections] : file.by_frame) {
    if (frame < sequence.frames()) continue;
    for (const Detection& detection : detections)
      sequence.rows.push_back(
          {frame, detection, file.columns[static_cast<std::size_t>(detection.row)]});
  }
  for (const CueRow& cue : kCueRows) {
    const std::string& path = dataset.appearance_paths[cue.cue];
    if (path.empty()) continue;
    const NpyMatrix matrix = ReadNpy(path);
    for (std::size_t i = first; i < sequence.rows.size(); ++i) {
      Detection& detection = sequence.rows[i].detection;
      const float* values = matrix.Row(static_cast<std::size_t>(detection.row));
      const Eigen::VectorXf vector =
          Eigen::Map<const Eigen::VectorXf>(values, static_cast<Eigen::Index>(matrix.columns));
      if (!(vector.allFinite() && vector.norm() > 0)) continue;
      const Eigen::VectorXf unit = vector.normalized();
      detection.appearance[cue.cue].assign(unit.begin(), unit.end());
    }
  }
}

}  // namespace

Sequence MakeSequence(const Dataset& dataset, const DetectionFile& file) {
  Sequence sequence;
  sequence.name = dataset.name;
  sequence.odometry_path = dataset.odometry_path;
  sequence.detections_path = dataset.detections_path;
  sequence.groundtruth_path = dataset.groundtruth_path;
  sequence.has_odometry = !dataset.odometry_path.empty();
  sequence.rows_read = dataset.rows_read;
  sequence.has_embeddings = !dataset.appearance_paths[Cue::kEmbedding].empty();
  sequence.camera = dataset.camera;
  sequence.camera_right = dataset.camera_right;
  sequence.up_axis = dataset.up_axis;
  sequence.labels = dataset.labels;
  sequence.groundtruth = dataset.groundtruth;
  for (const Frame& frame : dataset.frames) {
    sequence.stamps.push_back(frame.stamp);
    sequence.poses.push_back(frame.T_odom_cam);
    sequence.steps.push_back(frame.step);
    for (const Detection& detection : frame.detections) {
      const auto row = static_cast<std::size_t>(detection.row);
      sequence.rows.push_back({frame.index, detection,
                               detection.row >= 0 && row < file.columns.size()
                                   ? file.columns[row]
                                   : ColumnsOf(frame.index, detection)});
    }
  }
  if (dataset.rows_beyond_end > 0) AddRowsBeyondEnd(dataset, file, sequence);
  return sequence;
}

std::vector<std::vector<const Row*>> RowsByFrame(const Sequence& sequence) {
  std::vector<std::vector<const Row*>> rows(sequence.poses.size());
  for (const Row& row : sequence.rows)
    if (row.frame >= 0 && row.frame < sequence.frames())
      rows[static_cast<std::size_t>(row.frame)].push_back(&row);
  return rows;
}

}  // namespace sslcd::check
