// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"

namespace SSLCD_EXPORT sslcd {

/// The filter of detections (paper III-A.1: "excessively large or distant" ones are dropped).
struct DetectionFilterOptions {
  double min_score = 0.5;    ///< smallest score, a probability
  double max_range_m = 70.;  ///< distance from the camera to the cuboid's centre
  /// bounds of length, width and height of an object
  double min_size_m = 0.1, max_size_m = 30.;
  /// most detections of a frame; more take minutes, and no detector finds so many objects
  int max_count = 500;
};
void DescribeFields(FieldVisitor& visitor, DetectionFilterOptions& options);

/// Counts of filtered detections. Each detection counts once, for the first reason that applies.
struct FilterReport {
  int kept = 0;
  /// NaN or infinity in pose, size, score or appearance, a quaternion whose length is not 1, or a
  /// score that is no probability
  int invalid = 0;
  int low_score = 0;
  int too_far = 0;
  int wrong_size = 0;  ///< any dimension outside its range
  int too_many = 0;    ///< beyond the best ones of its frame
  int dropped() const { return invalid + low_score + too_far + wrong_size + too_many; }

  FilterReport& operator+=(const FilterReport& other);
};

/// Removes the detections of a frame that fail, and of the others all but the `max_count` with the
/// highest scores (of equal scores the first ones). Keeps the order of the rest.
FilterReport FilterDetections(std::vector<Detection>& detections,
                              const DetectionFilterOptions& options);

}  // namespace sslcd
