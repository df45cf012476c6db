// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "eval/wilson.h"

namespace sslcd {

/// One answer of a detector, e.g. one loop.
struct ScoredAnswer {
  double score = 0;  ///< higher is surer
  bool correct = false;
  double viewpoint_change_rad = 0;  ///< angle between the two headings; any sign, any turn
};

/// Precision and recall if every answer with score >= `threshold` is accepted.
struct PrecisionRecallPoint {
  double threshold = 0;
  int answered = 0, correct = 0;
  double precision = 0, recall = 0;
  Interval precision_interval, recall_interval;  ///< 95 %, Wilson
};

struct PrecisionRecall {
  /// by decreasing threshold; equal scores make one point
  std::vector<PrecisionRecallPoint> curve;
  int positives = 0;                    ///< number of true revisits (or matches) to find
  double average_precision = 0;         ///< sum over the curve of (recall step) * precision
  double recall_at_full_precision = 0;  ///< largest recall on the curve without a wrong answer
};

/// `positives` is the number of true revisits to find; if it is 0, recalls are 0. Throws Error
/// (kUsage) if there are more correct answers than positives, or if a score is not a number.
PrecisionRecall ComputePrecisionRecall(std::vector<ScoredAnswer> answers, int positives);

/// Bins of the viewpoint change: 0-45, 45-90, 90-135 and 135-180 degrees. A bin includes its lower
/// end; the last one also includes 180.
constexpr int kViewpointBins = 4;
constexpr std::array<const char*, kViewpointBins> kViewpointBinNames{"0-45", "45-90", "90-135",
                                                                     "135-180"};
/// The bin of an angle of any sign and any number of turns.
int ViewpointBin(double viewpoint_change_rad);

/// The same per bin, with `positives` per bin. Also throws Error (kUsage) if a viewpoint change is
/// not finite.
std::array<PrecisionRecall, kViewpointBins> ComputePrecisionRecallByViewpoint(
    const std::vector<ScoredAnswer>& answers, const std::array<int, kViewpointBins>& positives);

}  // namespace sslcd
