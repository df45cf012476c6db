// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "datasets/image_size.h"
#include "datasets/stamps.h"
#include "formats/calib.h"
#include "sslcd/core/cue.h"

namespace sslcd {

/// The paths of the parts of one sequence, and functions for the parts whose format varies. An
/// empty path means that the part is missing.
struct DatasetLayout {
  std::string format;       ///< name of the reader that found it
  std::string name;         ///< name of the sequence
  std::string odometry;     ///< pose file, or oxts packets (file or folder)
  std::string detections;   ///< file or folder, or tracklet_labels.xml
  std::string groundtruth;  ///< pose file or oxts packets
  std::string times, calib, sequence_yaml;
  PerCue<std::string> appearance;    ///< the files of cues
  std::string images, images_right;  ///< folders of the left and right images

  std::function<std::vector<double>(const std::string& path)> read_times = ReadTimes;
  std::function<Calibration(const std::string& path)> read_calibration =
      [](const std::string& path) { return ReadCalibration(path); };
  ImageSize image_size{};  ///< used if neither images nor sequence.yaml give it; 0: unknown

  /// `odometry` is the ground truth. It becomes `groundtruth` if the request names other odometry.
  bool odometry_is_truth = false;
  std::string groundtruth_boxes;  ///< annotated boxes, KITTI tracking rows
  /// The file names to suggest if odometry or detections are missing; empty: the format has none.
  std::string odometry_file, detections_file;
};

/// One dataset format.
struct DatasetReader {
  const char* name;         ///< the value of `--format`
  const char* description;  ///< the format and the files that identify it
  bool (*looks_like)(const std::string& folder);
  /// Returns the sequences in a folder; null: the folder itself is one sequence.
  std::set<std::string> (*sequences)(const std::string& folder);
  /// Finds the parts of a sequence; `sequence` is empty if the folder itself is one.
  DatasetLayout (*find)(const std::string& folder, const std::string& sequence);
};

/// All formats in the order of detection.
const std::vector<DatasetReader>& DatasetReaders();

}  // namespace sslcd
