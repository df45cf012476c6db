// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/cue.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// Eqs. 13 to 16 as printed, each in (0, 1]; none if an object lacks the property.
/// As printed, d_c and d_e decrease with the similarity of the vectors (exp(-|h h'|): 1 for
/// orthogonal, 0.37 for equal vectors), and d_p compares positions in the world, one of which has
/// drifted. This is kept to compare with the paper's method.
struct PaperCues {
  std::optional<double> scale;     ///< d_s = exp(-|d - d'|), dims in metres
  std::optional<double> position;  ///< d_p = exp(-|t - t'|), metres
  /// d_c = exp(-|h h'|) of the colour, d_e = exp(-|e e'|) of the embedding
  PerCue<std::optional<double>> appearance;
};

/// For objects with several views the dot product is the mean over all pairs of sightings, as in
/// Eqs. 5 and 6. Views of different lengths and vectors with NaN count as missing.
PaperCues CompareAsPrinted(const LayoutObject& local, const LayoutObject& global);

/// Eq. 12: s_l = mu (d_s + d_p) + (1 - mu) (d_c + d_e), mu in [0, 1]. In [0, 2]. A missing cue is
/// ignored, one beyond the paper's (core/cue.h) is added to d_c and d_e, and the weights are scaled
/// so that they sum to two. None without any cue of positive weight.
std::optional<double> PaperSimilarity(const PaperCues& cues, double mu);

/// Eq. 11: W_l, the similarity of two objects of the same label; zero for different labels or
/// without cues.
double SemanticSimilarity(const LayoutObject& local, const LayoutObject& global, double mu);

}  // namespace sslcd
