// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/io/calib_reader.h"
#include "sslcd/io/dataset.h"

namespace sslcd {

/// Where the parts of one sequence lie. Empty: there is none.
struct DatasetLayout {
  DatasetFormat format = DatasetFormat::kAuto;
  std::string name;
  /// pose file, or oxts packets (file or folder); empty only if made from the images
  std::string odometry;
  /// file or folder, or tracklet_labels.xml; empty only if made from the images
  std::string detections;
  std::string groundtruth;  ///< pose file or oxts packets
  std::string times;        ///< times.txt, or timestamps.txt of a raw drive
  std::string calib;        ///< calib.txt; for a raw drive the folder of calib_cam_to_cam.txt
  std::string sequence_yaml, embeddings, colours;
  std::string images, images_right;          ///< folders of the left and right images
  CameraPair cameras = CameraPair::kColour;  ///< whose images those are
  int image_digits = 6;                      ///< in the images' names
};

/// Finds out the format and the parts. Throws Error when the folder is none of the known kinds,
/// when the sequence is unknown or must be chosen, when a requested path does not exist, and when
/// odometry or detections are missing.
DatasetLayout FindDatasetLayout(const DatasetRequest& request);

}  // namespace sslcd
