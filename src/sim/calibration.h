// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/halv.h"

namespace sslcd::sim {

/// A property of HALV-sim: what it should be, and what it is.
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

/// Over random pairs of detections of cars. `pairs` are drawn of each kind, where there are such.
EmbeddingStats MeasureEmbeddings(const std::vector<HalvSequence>& sequences, int pairs);

/// Of all detections of parked cars and vans, compared with the truth.
struct DetectionStats {
  double iou = 0;    ///< mean 3D IoU: "raw" in eval/map_metrics.h
  double flips = 0;  ///< share that faces the other way
};
DetectionStats MeasureDetections(const World& world, const SimulatedDetections& detections);

/// All four cases with seeds 1 to `seeds`: the paper's figures and our own of docs/halv_sim.md.
/// Options other than the case are the caller's.
std::vector<CalibrationRow> Calibrate(int seeds, HalvOptions options = {});

/// As a Markdown table.
std::string ToMarkdown(const std::vector<CalibrationRow>& rows);

}  // namespace sslcd::sim
