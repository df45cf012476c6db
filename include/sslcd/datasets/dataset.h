// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/label.h"
#include "sslcd/core/pose.h"
#include "sslcd/formats/detections.h"
#include "sslcd/formats/poses.h"

namespace sslcd {

/// "auto", which means told by what is in the folder, then the dataset formats in the order in
/// which a folder is compared with them: "sequence", "kitti-odometry", "kitti-raw",
/// "kitti-tracking" (docs/formats.md).
std::vector<std::string> DatasetFormatNames();

/// How much a part is wanted that can be made from images, too. Where there is no odometry, the
/// frames' poses are the identity, and there are as many as stamps, else as the last left image's
/// number says; without detections, theirs are none.
enum class PartPolicy {
  kNeeded,   ///< an error where there is none
  kIfThere,  ///< none is no error where there are left and right images
  kIgnored,  ///< not read
};

/// What to load. Empty paths mean the standard place of the format; others are tried relative to
/// `path`, then to the current folder. Where one leads to a folder that holds SEQUENCE.txt, that
/// file is meant.
struct DatasetRequest {
  std::string path;
  std::string format = "auto";  ///< one of DatasetFormatNames()
  std::string sequence;         ///< "0007"; may be empty where there is only one
  std::string detections;       ///< required for KITTI tracking, which brings none
  std::string odometry;         ///< likewise
  std::string groundtruth;
  DetectionReadOptions detection_options;
  int max_frames = 0;  ///< only the first so many; 0: all
  PartPolicy odometry_policy = PartPolicy::kNeeded, detections_policy = PartPolicy::kNeeded;
};

/// A sequence in memory. Ground truth is for evaluation only and never enters the frames, with one
/// named exception: a KITTI raw drive without `odometry` uses its GPS/IMU poses (then there is no
/// ground truth, and a warning says so).
struct Dataset {
  std::string format;  ///< as found, never "auto"
  std::string name;
  std::vector<Frame> frames;  ///< one per pose; frames[i].index == i, stamps increase
  /// P2, of grey images P0; none: no calibration, nothing can be projected
  std::optional<Camera> camera;
  std::optional<Camera> camera_right;  ///< P3 or P1
  /// unit vector in the odometry's world: sequence.yaml, else -y, or +z for a VINS-Fusion csv
  Vec3 up_axis{0, -1, 0};
  LabelTable labels;
  /// rows without stamps got those of the frames
  std::optional<Trajectory> groundtruth;
  std::string odometry_path, detections_path, groundtruth_path;  ///< as found; empty: there is none
  PoseFormat odometry_format = PoseFormat::kAuto;                ///< kKitti for GPS/IMU packets
  /// detection rows; the following are among them
  int rows_read = 0;
  /// not finite, or sizes that are not positive
  int rows_dropped = 0;
  int rows_dont_care = 0;   ///< class DontCare
  int rows_beyond_end = 0;  ///< of frames that have no pose
  /// what was put up with, a sentence each
  std::vector<std::string> warnings;
};

/// Loads a dataset folder.
/// Stamps come from times.txt (raw drives: timestamps.txt), else from the odometry, else every 0.1
/// s. Odometry without stamps must have as many rows as there are stamps; odometry with stamps is
/// looked up by stamp, to half a frame step. Throws Error (kBadInput, or kUsage for a choice the
/// caller has to make) saying where and what to do.
Dataset LoadDataset(const DatasetRequest& request);

}  // namespace sslcd
