// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sslcd/core/cue.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// Eqs. 13 to 16 as printed, each in (0, 1]; none where either object lacks the property.
///
/// As printed, d_c and d_e fall as the vectors become more alike (exp(-|h h'|): 1 for nothing in
/// common, 0.37 for the same), and d_p compares positions in the world, of which one is drifted.
/// Both are kept here on purpose: this is the paper's method, for comparison.
struct PaperCues {
  std::optional<double> scale;     ///< d_s = exp(-|d - d'|), dims in metres
  std::optional<double> position;  ///< d_p = exp(-|t - t'|), metres
  /// d_c = exp(-|h h'|) of the colour, d_e = exp(-|e e'|) of the embedding
  PerCue<std::optional<double>> appearance;
};

/// Where an object has several views, the dot product is the mean over all pairs of sightings, as
/// in Eqs. 5 and 6. Views of different lengths cannot be compared and count as missing; so do
/// vectors with NaN.
PaperCues CompareAsPrinted(const LayoutObject& local, const LayoutObject& global);

/// Eq. 12: s_l = mu (d_s + d_p) + (1 - mu) (d_c + d_e), mu in [0, 1]. In [0, 2]. A cue that is
/// missing drops out, one beyond the paper's (core/cue.h) joins d_c and d_e, and the weights are
/// scaled so that they sum to two again. None without any cue of positive weight.
std::optional<double> PaperSimilarity(const PaperCues& cues, double mu);

/// Eq. 11: W_l, the similarity of two objects of one label; zero for different labels and where
/// there is no cue.
double SemanticSimilarity(const LayoutObject& local, const LayoutObject& global, double mu);

}  // namespace sslcd
