// SPDX-License-Identifier: BSD-3-Clause
#include "association/score.h"

namespace sslcd {

std::optional<double> AssociationScore(const SimilarityCues& cues, double lambda) {
  double sum = 0, weights = 0;
  const auto add = [&](const std::optional<double>& cue, double weight) {
    if (!cue) return;
    sum += weight * *cue;
    weights += weight;
  };
  add(cues.iou, lambda);
  for (const CueRow& row : kCueRows) add(cues.appearance[row.cue], row.weight(lambda));
  if (weights <= 0) return std::nullopt;
  return sum / weights;
}

}  // namespace sslcd
