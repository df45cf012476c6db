// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/association/score.h"

namespace sslcd {

std::optional<double> AssociationScore(const SimilarityCues& cues, double lambda) {
  double sum = 0, weights = 0;
  const auto add = [&](const std::optional<double>& cue, double weight) {
    if (!cue) return;
    sum += weight * *cue;
    weights += weight;
  };
  add(cues.iou, lambda);
  add(cues.histogram, lambda * (1 - lambda));
  add(cues.embedding, (1 - lambda) * (1 - lambda));
  if (weights <= 0) return std::nullopt;
  return sum / weights;
}

}  // namespace sslcd
