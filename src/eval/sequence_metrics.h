// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "eval/precision_recall.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// A run on a sequence with true poses and true identities. Poses are T_world_cam by frame number,
/// in KITTI camera axes (x right, y down, z forward). Longer lists are cut to the shortest.
struct SequenceRun {
  std::vector<Pose> estimate, odometry, reference;
  /// the input detections: frame numbers and rows are used
  std::vector<Frame> frames;
  /// the true identity of each detection row; negative: a false alarm
  std::vector<int> identities;
  std::vector<LoopClosure> loops;  ///< only accepted ones count
  std::vector<MapObject> objects;  ///< the final map; only confirmed ones count
};

struct SequenceMetricOptions {
  double true_loop_m = 5.;          ///< a loop with at least this horizontal error is wrong
  double true_loop_height_m = 1.5;  ///< a loop with at least this height error is wrong
  /// a loop with at least this rotation error is wrong
  double true_loop_rad = 5. * 0.017453292519943295;
  // A path segment is a revisit if at least `common` identities of its last `recent_m` were seen
  // more than `old_m` of path earlier.
  /// path between two segment ends, the first at old_m; a loop counts for the ends within this path
  double spacing_m = 10.;
  double recent_m = 40.;
  double old_m = 60.;
  int common = 5;
};

struct SequenceMetrics {
  double ate = 0, ate_odometry = 0;  ///< after SE(3) alignment, RMSE [m]
  double path = 0;                   ///< length of the reference [m]
  int loops = 0, wrong_loops = 0;
  int wrong_in_height = 0;  ///< wrong loops whose height error is too large
  /// true loops per bin of the change of heading
  std::array<int, kViewpointBins> true_by_viewpoint{};
  int revisited_stretches = 0;
  double recall = 0;  ///< share of the revisited segments in which a true loop was found
  std::optional<double> loop_error_median_m, loop_error_median_rad;
  int landmarks = 0, true_landmarks = 0;
  double landmarks_per_true = 0;  ///< landmarks per identity that owns one
  double purity = 0;              ///< see MapMetrics
};

/// Throws Error (kUsage) if there are no poses, or if a frame of a loop or a detection row of the
/// map is out of range.
SequenceMetrics ComputeSequenceMetrics(const SequenceRun& run,
                                       const SequenceMetricOptions& options = {});

}  // namespace sslcd
