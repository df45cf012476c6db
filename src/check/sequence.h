// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/datasets/dataset.h"

namespace sslcd::check {

/// A detection and the columns of its row.
struct Row {
  int frame = 0;  ///< may be beyond the last pose
  Detection detection;
  DetectionColumns written;
};

/// A dataset as the tests see it. A test that finds a mistake repairs a copy, on which the next
/// tests run.
struct Sequence {
  std::string name, odometry_path, detections_path, groundtruth_path;
  bool has_odometry = false;  ///< false: the poses are made later, from images
  std::vector<double> stamps;
  std::vector<Pose> poses;  ///< T_odom_cam, one a frame
  std::vector<std::optional<StepUncertainty>> steps;
  std::vector<Row> rows;        ///< by frame
  int rows_read = 0;            ///< with those that the reader drops
  bool has_embeddings = false;  ///< a file of them, be they 0
  std::optional<Camera> camera, camera_right;
  Vec3 up_axis{0, -1, 0};
  LabelTable labels;
  std::optional<Trajectory> groundtruth;

  int frames() const { return static_cast<int>(poses.size()); }
};

/// `rows` are those of the file that `dataset` was loaded from, including the ones of frames
/// without a pose; without a file (empty), those of the frames.
Sequence MakeSequence(const Dataset& dataset, const DetectionFile& file);

/// The rows of each frame that has a pose.
std::vector<std::vector<const Row*>> RowsByFrame(const Sequence& sequence);

}  // namespace sslcd::check
