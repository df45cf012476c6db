// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/map_json.h"
#include "formats/metrics_json.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"

namespace sslcd::apps {

/// A finished run and its ground truth. Everything but the estimate is optional.
struct EvaluationInput {
  Trajectory estimate;                    ///< T_world_cam, one per frame
  std::vector<int> frames;                ///< frame numbers of the estimate
  std::optional<Trajectory> groundtruth;  ///< T_world_cam
  bool groundtruth_has_stamps = true;     ///< false (KITTI rows): row i is frame i
  std::optional<Trajectory> odometry;
  const MapFile* map = nullptr;
  std::string labels_path;  ///< KITTI tracking label_02 file; empty: no map metrics
  const std::vector<Frame>* detections = nullptr;
  std::vector<int> identities;  ///< true identity of each detection row; empty: no loop metrics
  std::vector<LoopClosure> loops;
};

/// Computes absolute (all alignments) and relative trajectory errors. Adds the map's accuracy and
/// identities if there are labels, and metrics of loops, revisits and identities if there are true
/// identities. All of them need ground-truth poses: without these it returns no metrics and warns
/// about unused labels; those of the map and the loops need one for each frame.
Metrics Evaluate(const EvaluationInput& input);

}  // namespace sslcd::apps
