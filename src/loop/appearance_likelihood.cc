// SPDX-License-Identifier: BSD-3-Clause
#include "loop/appearance_likelihood.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

// Of vectors of one size.
double Dot(const std::vector<float>& a, const std::vector<float>& b) {
  const auto size = static_cast<Eigen::Index>(a.size());
  const Eigen::Map<const Eigen::VectorXf> first(a.data(), size), second(b.data(), size);
  return static_cast<double>(first.dot(second));
}

// Log ratio of two normal densities of equal width.
double LogRatio(double value, double mean, double other_mean, double sigma) {
  const double a = (value - mean) / sigma, b = (value - other_mean) / sigma;
  return 0.5 * (b * b - a * a);
}

// Cosine of the angle between two views: 1 for the same side, -1 for opposite sides; a mean value
// if sides are not distinguished.
double SharedSide(const AppearanceView& a, const AppearanceView& b, Symmetry symmetry) {
  if (symmetry == Symmetry::kFull) return 1;  // looks the same from all sides
  const double cosine = std::cos(a.viewpoint_rad - b.viewpoint_rad);
  return symmetry == Symmetry::kPi ? std::abs(cosine) : cosine;
}

// Mean over all pairs of views, weighted by the sightings behind them: views of one object are not
// independent. `gain` takes a pair of views.
template <class Gain>
double MeanOverViews(const std::vector<AppearanceView>& a, const std::vector<AppearanceView>& b,
                     const Gain& gain) {
  double sum = 0, weights = 0;
  for (const AppearanceView& p : a) {
    for (const AppearanceView& q : b) {
      if (p.vector.empty() || p.vector.size() != q.vector.size()) continue;
      const double weight = static_cast<double>(p.count) * q.count, value = gain(p, q);
      if (!(weight > 0) || !std::isfinite(value)) continue;
      sum += weight * value;
      weights += weight;
    }
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace

PerCue<CosineStatistics> CosinesOfTable() {
  PerCue<CosineStatistics> cosines;
  for (const CueRow& row : kCueRows) cosines[row.cue] = row.cosine;
  return cosines;
}

void DescribeFields(FieldVisitor& visitor, AppearanceOptions& options) {
  CosineStatistics& embedding = options.cosine[Cue::kEmbedding];
  visitor.Real("same_side", embedding.same_side, -1, 1,
               "mean cosine of one object's embeddings, seen from one side");
  visitor.Real("opposite_side", embedding.opposite_side, -1, 1,
               "mean cosine of one object's embeddings, seen from opposite sides");
  visitor.Real("other_object", embedding.other_object, -1, 1,
               "mean cosine of different objects' embeddings");
  visitor.Real("limit", options.limit, 0, 100,
               "most evidence of one object's appearance, for or against [nats]");
}

double AppearanceGain(const LayoutObject& a, const LayoutObject& b, const AppearanceOptions& o) {
  double sum = 0;
  for (const CueRow& row : kCueRows) {
    const CosineStatistics& cosine = o.cosine[row.cue];
    const double gain = MeanOverViews(
        a.appearance[row.cue], b.appearance[row.cue], [&](const auto& p, const auto& q) {
          const double side = 0.5 + 0.5 * SharedSide(p, q, a.symmetry);
          const double same =
              cosine.opposite_side + side * (cosine.same_side - cosine.opposite_side);
          return LogRatio(Dot(p.vector, q.vector), same, cosine.other_object, cosine.sigma);
        });
    const double limit = row.limit_share.value_or(0.) * o.limit;
    sum += row.limit_share ? std::clamp(gain, -limit, limit) : gain;
  }
  return std::clamp(sum, -o.limit, o.limit);
}

}  // namespace sslcd
