// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace sslcd {

/// The cues that compare a detection d_i with a landmark o_k, each in [0, 1]; none where the data
/// has no such thing.
struct SimilarityCues {
  std::optional<double> iou;        ///< Eq. 4: detected box against the landmark's projected cuboid
  std::optional<double> histogram;  ///< Eq. 5: colour vectors
  std::optional<double> embedding;  ///< Eq. 6: re-identification vectors
};

/// Eq. 3: s_d = lambda iou + lambda (1 - lambda) his + (1 - lambda)^2 dis, lambda in [0, 1].
/// The three weights sum to one; a missing cue drops out and the others are scaled up so that they
/// sum to one again. No cue at all (or only cues of weight zero): none.
std::optional<double> AssociationScore(const SimilarityCues& cues, double lambda);

}  // namespace sslcd
