// SPDX-License-Identifier: BSD-3-Clause
#include "loop/semantics.h"

#include <cmath>
#include <numeric>

namespace sslcd {
namespace {

/// Mean dot product over all pairs of sightings.
std::optional<double> MeanDot(const std::vector<AppearanceView>& a,
                              const std::vector<AppearanceView>& b) {
  double sum = 0, weights = 0;
  for (const AppearanceView& u : a) {
    for (const AppearanceView& v : b) {
      if (u.vector.empty() || u.vector.size() != v.vector.size()) continue;
      const double weight = static_cast<double>(u.count) * v.count;
      sum += weight * std::inner_product(u.vector.begin(), u.vector.end(), v.vector.begin(), 0.);
      weights += weight;
    }
  }
  if (!(weights > 0) || !std::isfinite(sum)) return std::nullopt;
  return sum / weights;
}

std::optional<double> Decay(std::optional<double> difference) {
  if (!difference || !std::isfinite(*difference)) return std::nullopt;
  return std::exp(-std::abs(*difference));
}

bool IsKnown(const Vec3& dims) { return dims.allFinite() && (dims.array() > 0).any(); }

}  // namespace

PaperCues CompareAsPrinted(const LayoutObject& local, const LayoutObject& global) {
  PaperCues cues;
  if (IsKnown(local.dims) && IsKnown(global.dims))
    cues.scale = Decay((local.dims - global.dims).norm());
  cues.position = Decay((local.position - global.position).norm());
  for (const CueRow& row : kCueRows)
    cues.appearance[row.cue] =
        Decay(MeanDot(local.appearance[row.cue], global.appearance[row.cue]));
  return cues;
}

std::optional<double> PaperSimilarity(const PaperCues& cues, double mu) {
  double sum = 0, weights = 0;
  const auto add = [&](const std::optional<double>& cue, double weight) {
    if (!cue) return;
    sum += weight * *cue;
    weights += weight;
  };
  add(cues.scale, mu);
  add(cues.position, mu);
  for (const CueRow& row : kCueRows) add(cues.appearance[row.cue], 1 - mu);
  if (!(weights > 0)) return std::nullopt;
  return 2 * sum / weights;
}

double SemanticSimilarity(const LayoutObject& local, const LayoutObject& global, double mu) {
  if (local.label != global.label) return 0;
  return PaperSimilarity(CompareAsPrinted(local, global), mu).value_or(0.);
}

}  // namespace sslcd
