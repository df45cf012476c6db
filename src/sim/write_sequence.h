// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sim/sensor.h"
#include "sim/world.h"
#include "sslcd/core/pose.h"

namespace sslcd::sim {

/// Writes an ordinary sequence folder: calib.txt, times.txt, odometry.txt and groundtruth.txt
/// (TUM), detections.txt (KITTI tracking rows with score), sequence.yaml, landmark_ids.txt with the
/// true identity of every row (for evaluation only), and, if the detections have them,
/// embeddings.npy and colours.npy. Creates the folder if necessary. Throws Error(kUsage) if the
/// folder is not empty and `overwrite` is not set, and Error(kOutput) if it cannot be written. Each
/// file is written completely or not at all.
void WriteSequence(const World& world, const Trajectory& odometry,
                   const SimulatedDetections& detections, const std::filesystem::path& folder,
                   bool overwrite = false);

}  // namespace sslcd::sim
