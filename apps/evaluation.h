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

/// What a finished run is compared with. Everything but the estimate is optional.
struct EvaluationInput {
  Trajectory estimate;                    ///< one pose a frame
  std::vector<int> frames;                ///< frame numbers of the estimate
  std::optional<Trajectory> groundtruth;  ///< without stamps (KITTI rows): row = frame number
  bool groundtruth_has_stamps = false;
  std::optional<Trajectory> odometry;
  const MapFile* map = nullptr;
  std::string labels_path;  ///< KITTI tracking label_02 file; empty: no map metrics
  const std::vector<Frame>* detections = nullptr;
  std::vector<int> identities;  ///< the true one of each detection row; empty: no metrics of loops
  std::vector<LoopClosure> loops;
};

/// Trajectory error (all alignments), relative error, the map's accuracy and identities where
/// labels are there, and loops, revisits and identities where true identities are. All of them
/// need ground-truth poses: without these there are no metrics, and a warning names labels that
/// could not be used.
Metrics Evaluate(const EvaluationInput& input);

}  // namespace sslcd::apps
