// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmark/table.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::apps {

/// The paper's Table I: 3D IoU of parked cars, of single detections and of the map. Runs every
/// sequence of a KITTI tracking folder that has detections in the folders `detections`, odometry in
/// orbslam3_poses and true poses in oxts_cam0_poses. Without `detections` it takes
/// det_stereo_grade_car and det_pointrcnn_car if they exist. Throws Error(kBadInput) if a named
/// folder is missing or no sequence is complete. Empty if `stop` ended it early.
benchmark::Table KittiTable(const std::string& folder, const std::vector<std::string>& detections,
                            const Options& options, const std::function<bool()>& stop);

}  // namespace sslcd::apps
