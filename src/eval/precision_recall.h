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

/// What is reached when every answer with score >= `threshold` is believed.
struct PrecisionRecallPoint {
  double threshold = 0;
  int answered = 0, correct = 0;
  double precision = 0, recall = 0;
  Interval precision_interval, recall_interval;  ///< 95 %, Wilson
};

struct PrecisionRecall {
  std::vector<PrecisionRecallPoint> curve;  ///< by falling threshold; equal scores make one point
  int positives = 0;                        ///< how many there were to be found
  double average_precision = 0;             ///< sum over the curve of (recall step) * precision
  double recall_at_full_precision = 0;      ///< largest recall on the curve without a wrong answer
};

/// `positives`: how many there were to be found; without any, recalls are 0. Throws Error (kUsage):
/// more correct answers than positives; a score that is not a number.
PrecisionRecall ComputePrecisionRecall(std::vector<ScoredAnswer> answers, int positives);

/// Bins of the viewpoint change: 0-45, 45-90, 90-135, 135-180 degrees, the lower end included (and
/// 180 in the last).
constexpr int kViewpointBins = 4;
constexpr std::array<const char*, kViewpointBins> kViewpointBinNames{"0-45", "45-90", "90-135",
                                                                     "135-180"};
int ViewpointBin(double viewpoint_change_rad);

/// The same per bin; `positives` as well. A viewpoint change that is not finite is an Error, too.
std::array<PrecisionRecall, kViewpointBins> ComputePrecisionRecallByViewpoint(
    const std::vector<ScoredAnswer>& answers, const std::array<int, kViewpointBins>& positives);

}  // namespace sslcd
