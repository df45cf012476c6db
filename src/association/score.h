// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/cue.h"

namespace sslcd {

/// The similarity cues of a detection d_i and a landmark o_k, each in [0, 1]; none if the data is
/// missing.
struct SimilarityCues {
  std::optional<double> iou;  ///< Eq. 4: detected box against the landmark's projected cuboid
  /// dot product with the landmark's past vectors: Eq. 5 for the colour, Eq. 6 for the embedding
  PerCue<std::optional<double>> appearance;
};

/// Eq. 3: s_d = lambda iou + lambda (1 - lambda) his + (1 - lambda)^2 dis, lambda in [0, 1].
/// The three weights sum to one. A missing cue is ignored, a cue beyond the paper's (core/cue.h) is
/// added, and the weights are scaled so that they sum to one. Returns none without any cue of
/// positive weight.
std::optional<double> AssociationScore(const SimilarityCues& cues, double lambda);

}  // namespace sslcd
