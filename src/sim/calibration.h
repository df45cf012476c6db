// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/halv.h"

namespace sslcd::sim {

/// A property of HALV-sim: its target and its value.
struct CalibrationRow {
  std::string what;
  double target = 0, reached = 0;
  bool ok() const;  ///< within 10 % of the target
};

/// Mean and standard deviation of the cosines of pairs of embeddings.
struct CosineStats {
  double mean = 0, sigma = 0;
  int pairs = 0;
};
struct EmbeddingStats {
  CosineStats same_side;      ///< one object, from directions less than 45 degrees apart
  CosineStats opposite_side;  ///< one object, from directions more than 135 degrees apart
  CosineStats other_object;
};

/// Statistics over random pairs of detections of cars: `pairs` of each kind, if the kind exists.
EmbeddingStats MeasureEmbeddings(const std::vector<HalvSequence>& sequences, int pairs);

/// Errors of all detections of parked cars and vans.
struct DetectionStats {
  double iou = 0;    ///< mean 3D IoU: "raw" in eval/map_metrics.h
  double flips = 0;  ///< share with reversed heading
};
DetectionStats MeasureDetections(const World& world, const SimulatedDetections& detections);

/// Compares all four cases with seeds 1 to `seeds` with the paper's figures and with
/// docs/halv_sim.md. The caller sets all options except the case.
std::vector<CalibrationRow> Calibrate(int seeds, HalvOptions options = {});

/// Formats the comparison as a Markdown table.
std::string ToMarkdown(const std::vector<CalibrationRow>& rows);

}  // namespace sslcd::sim
