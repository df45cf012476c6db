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

/// Finds the image of a frame in a folder; empty: there is none.
using ImageFinder = std::function<std::string(const std::string& folder, int frame)>;

/// Images named by frame number, as PNG or JPEG: 6 digits stand for 000000.png.
ImageFinder NumberedImages(int digits);

/// Where the parts of one sequence are, and how to read those that are not alike in all formats.
/// Empty paths: the part is not there.
struct DatasetLayout {
  std::string format;       ///< of the reader that found it
  std::string name;         ///< of the sequence
  std::string odometry;     ///< pose file, or oxts packets (file or folder)
  std::string detections;   ///< file or folder, or tracklet_labels.xml
  std::string groundtruth;  ///< pose file or oxts packets
  std::string times, calib, sequence_yaml;
  PerCue<std::string> appearance;    ///< the files of cues
  std::string images, images_right;  ///< folders of the left and right images

  std::function<std::vector<double>(const std::string& path)> read_times = ReadTimes;
  std::function<Calibration(const std::string& path)> read_calibration =
      [](const std::string& path) { return ReadCalibration(path); };
  ImageFinder find_image = NumberedImages(6);
  ImageSize image_size{};  ///< where neither images nor sequence.yaml tell it; 0: unknown

  /// `odometry` is the ground truth, and becomes that when other odometry is named.
  bool odometry_is_truth = false;
  std::string groundtruth_boxes;  ///< annotated boxes, KITTI tracking rows
  /// What to add to the folder where odometry or detections are missing, for messages; empty: the
  /// format has no place for them.
  std::string odometry_file, detections_file;
};

/// One dataset format.
struct DatasetReader {
  const char* name;         ///< as `--format` takes it
  const char* description;  ///< what the format is, and by what in the folder it is told
  bool (*looks_like)(const std::string& folder);
  /// The sequences in a folder; null: the folder itself is one sequence.
  std::set<std::string> (*sequences)(const std::string& folder);
  /// Where the parts of a sequence are; `sequence` is empty where the folder itself is one.
  DatasetLayout (*find)(const std::string& folder, const std::string& sequence);
};

/// All formats, in the order in which they are tried.
const std::vector<DatasetReader>& DatasetReaders();

}  // namespace sslcd
