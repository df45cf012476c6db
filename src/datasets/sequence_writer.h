// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formats/file_lock.h"
#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/label.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// A sequence folder (docs/formats.md) in memory.
struct SequenceFiles {
  std::string comment;  ///< first line of sequence.yaml; empty: none
  std::optional<StereoCamera> camera;
  Trajectory odometry;                             ///< T_odom_cam with stamps, one per frame
  std::optional<Trajectory> groundtruth;           ///< for evaluation only
  std::vector<std::vector<Detection>> detections;  ///< per frame
  Vec3 up_axis{0, -1, 0};
  LabelTable labels;
  std::string config_yaml;  ///< options for `sslcd_run run` on this sequence; empty: no file
};

/// Writes times.txt, odometry.txt (TUM), detections.txt (KITTI tracking rows with score),
/// sequence.yaml, and, as far as the parts exist, config.yaml, calib.txt, groundtruth.txt (TUM) and
/// the files of cues (core/cue.h): embeddings.npy (a row of zeros for a detection without one) and
/// colours.npy (only if every detection has one). Writes all files or none, and removes the files
/// of an earlier run whose parts are missing, except config.yaml: a WriteFileSet() of the name
/// "sequence". Throws Error(kOutput).
void WriteSequenceFiles(const std::filesystem::path& folder, const SequenceFiles& files);

/// Creates the folder and locks it (LockFolder). Throws Error(kUsage) if it is not empty and
/// `overwrite` is not set, with what to do then, and Error(kOutput) if it cannot be created or
/// another process writes.
[[nodiscard]] FileLock PrepareSequenceFolder(
    const std::filesystem::path& folder, bool overwrite,
    const std::string& way_out = "choose another folder or overwrite it (--force)");

}  // namespace sslcd
