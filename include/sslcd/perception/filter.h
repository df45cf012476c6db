// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/fields.h"

namespace sslcd {

/// Which detections are worth using (paper III-A.1: "excessively large or distant" ones are
/// dropped).
struct DetectionFilterOptions {
  double min_score = 0.5;
  double max_range_m = 70.;  ///< distance from the camera to the cuboid's centre
  /// Length, width and height of an object all lie between these.
  double min_size_m = 0.1, max_size_m = 30.;
};
void DescribeFields(FieldVisitor& visitor, DetectionFilterOptions& options);

/// What became of the detections; each one is counted once, under the first reason that holds.
struct FilterReport {
  int kept = 0;
  int not_finite = 0;  ///< NaN or infinity in pose, size or score
  int low_score = 0;
  int too_far = 0;
  int wrong_size = 0;  ///< any dimension outside its range
  int dropped() const { return not_finite + low_score + too_far + wrong_size; }

  FilterReport& operator+=(const FilterReport& other);
};

/// Drops what fails; the order of the others stays.
FilterReport FilterDetections(std::vector<Detection>& detections,
                              const DetectionFilterOptions& options);

}  // namespace sslcd
