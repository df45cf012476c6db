// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/export.h"
#include "sslcd/core/label.h"
#include "sslcd/core/pose.h"
#include "sslcd/formats/detections.h"
#include "sslcd/formats/poses.h"

namespace SSLCD_EXPORT sslcd {

/// Returns "auto" (detect the format from the folder) and the names of the dataset formats in the
/// order of detection: "sequence", "kitti-odometry", "kitti-raw", "kitti-tracking"
/// (docs/formats.md).
std::vector<std::string> DatasetFormatNames();

/// Whether odometry or detections must exist; both can also be made from images. Without odometry
/// all poses are the identity, and the number of frames is the number of stamps, or follows from
/// the number of the last left image if there are no stamps. Without detections the frames have
/// none.
enum class PartPolicy {
  kNeeded,   ///< a missing part is an error
  kIfThere,  ///< a missing part is an error unless there are left and right images
  kIgnored,  ///< not read
};

/// The dataset to load. An empty path means the format's standard place. Any other path is relative
/// to `path`, otherwise to the current folder. A folder that contains SEQUENCE.txt stands for that
/// file.
struct DatasetRequest {
  std::string path;             ///< folder of the dataset
  std::string format = "auto";  ///< one of DatasetFormatNames()
  std::string sequence;         ///< e.g. "0007"; may be empty if there is only one
  std::string detections;       ///< required for KITTI tracking, whose folders have none
  std::string odometry;         ///< required for KITTI tracking
  std::string groundtruth;      ///< T_world_cam, for evaluation only
  DetectionReadOptions detection_options;
  int max_frames = 0;  ///< load only the first frames; 0: all
  PartPolicy odometry_policy = PartPolicy::kNeeded, detections_policy = PartPolicy::kNeeded;
};

/// A sequence in memory. Ground truth is for evaluation only and never enters the frames, with one
/// named exception: a KITTI raw drive without `odometry` uses its GPS/IMU poses (then there is no
/// ground truth, and a warning says so).
struct Dataset {
  std::string format;  ///< the detected format, never "auto"
  std::string name;
  std::vector<Frame> frames;  ///< one per pose; frames[i].index == i, stamps increase
  /// P2 (grey images: P0); none: no calibration, so nothing can be projected
  std::optional<Camera> camera;
  std::optional<Camera> camera_right;  ///< P3 or P1
  /// unit vector in the odometry's world: from sequence.yaml, otherwise -y, or +z for a VINS-Fusion
  /// csv
  Vec3 up_axis{0, -1, 0};
  LabelTable labels;
  /// T_world_cam, with stamps of the frames' clock (poses without stamps get those of the frames);
  /// none: there is no file, or its stamps are of another clock (a warning)
  std::optional<Trajectory> groundtruth;
  /// resolved paths; empty: there is none
  std::string odometry_path, detections_path, groundtruth_path;
  PerCue<std::string> appearance_paths;  ///< the files of cues that were read, likewise
  /// annotated boxes of the sequence (ReadKittiTrackingLabels); empty: there are none
  std::string groundtruth_boxes_path;
  PoseFormat odometry_format = PoseFormat::kAuto;  ///< kKitti for GPS/IMU packets
  /// what a path holds ("odometry", "stamps", ...) and the path, of all files and folders of the
  /// sequence that were found
  std::vector<std::pair<std::string, std::string>> parts;
  /// all detection rows, including those counted below
  int rows_read = 0;
  /// rows with values that are not finite or sizes that are not positive
  int rows_dropped = 0;
  int rows_dont_care = 0;   ///< rows of class DontCare
  int rows_beyond_end = 0;  ///< rows of frames without a pose
  /// tolerated defects of the dataset, one sentence each
  std::vector<std::string> warnings;
};

/// Loads a dataset folder.
/// Stamps come from times.txt (raw drives: timestamps.txt), otherwise from the odometry, otherwise
/// they are 0.1 s apart. Odometry without stamps must have one row per stamp. Odometry with stamps
/// is associated by stamp, within half a frame step. Throws Error(kBadInput), or Error(kUsage) if
/// the caller has to make a choice.
Dataset LoadDataset(const DatasetRequest& request);

}  // namespace sslcd
