// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmark/table.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::apps {

/// The paper's Table I: 3D IoU of standing cars, of single detections and of the map, for every
/// sequence of a KITTI tracking folder (with odometry in orbslam3_poses and, where known, true
/// poses in oxts_cam0_poses) that the folders `detections` in it have; none named: the usual two,
/// if there. Throws Error(kBadInput) for one that is not there, and where there is none at all.
/// Empty where `stop` ended it early.
benchmark::Table KittiTable(const std::string& folder, const std::vector<std::string>& detections,
                            const Options& options, const std::function<bool()>& stop);

}  // namespace sslcd::apps
