// SPDX-License-Identifier: BSD-3-Clause
#include "change/looks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sslcd {
namespace {

// Share of the detections of a session that agree on the heading. Set by hand.
constexpr double kAgree = 0.75;
// The n sightings of a session are those of a neighbour with probability kStrange / (1 + n). Chosen
// on HALV-sim (docs/change.md).
constexpr double kStrange = 0.2;
// Weight of the priors, in pairs, and smallest standard deviation of a cosine. Set by hand.
constexpr double kPrior = 4, kLeastSigma = 0.01;
// Prior probabilities that front and back have changed: of the same object, which a detector saw
// reversed in one of the sessions, and of another one. Set by hand.
constexpr double kSameReversed = 0.05, kOtherReversed = 0.35;

// Cosine of the angle between two views: 1 for the same side, -1 for opposite sides.
double SharedSide(const AppearanceView& a, const AppearanceView& b, Symmetry symmetry) {
  if (symmetry == Symmetry::kFull) return 1;  // looks the same from all sides
  const double cosine = std::cos(a.viewpoint_rad - b.viewpoint_rad);
  return symmetry == Symmetry::kPi ? std::abs(cosine) : cosine;
}

std::optional<LookPair::Similarity> Compare(const Gallery& a, const Gallery& b, Symmetry symmetry) {
  std::array<double, 2> sum{}, weight{};
  const std::vector<AppearanceView> others = b.Views();
  for (const AppearanceView& one : a.Views()) {
    for (const AppearanceView& other : others) {
      if (one.vector.size() != other.vector.size()) continue;
      const int side = SharedSide(one, other, symmetry) >= 0 ? 0 : 1;
      const double pairs = static_cast<double>(one.count) * other.count;
      sum[side] += pairs * std::inner_product(one.vector.begin(), one.vector.end(),
                                              other.vector.begin(), 0.);
      weight[side] += pairs;
    }
  }
  for (const int side : {0, 1})
    if (weight[side] > 0 && std::isfinite(sum[side]))
      return LookPair::Similarity{sum[side] / weight[side], side};
  return std::nullopt;
}

// 1: as the landmark, -1: against it, 0: unclear
int HeadingOf(const SessionLooks& looks) {
  const double all = looks.ahead + looks.reversed;
  if (all == 0) return 0;
  if (looks.ahead >= kAgree * all) return 1;
  return looks.reversed >= kAgree * all ? -1 : 0;
}

}  // namespace

LookPair Compare(const SessionLooks& a, const SessionLooks& b, Symmetry symmetry) {
  LookPair pair;
  pair.sightings = std::min(a.sightings, b.sightings);
  if (pair.sightings == 0) return pair;
  for (const CueRow& row : kCueRows)
    pair.cues[row.cue] = Compare(a.views[row.cue], b.views[row.cue], symmetry);
  const int headings = HeadingOf(a) * HeadingOf(b);
  if (symmetry == Symmetry::kNone && headings != 0) pair.reversed = headings < 0;
  return pair;
}

LearntNormal LearntNormal::Prior(double mean, double sigma, double weight) {
  return {weight, weight * mean, weight * (mean * mean + sigma * sigma)};
}

void LearntNormal::Add(double value, double w) {
  weight += w;
  sum += w * value;
  squares += w * value * value;
}

double LearntNormal::LogDensity(double value) const {
  const double mean = Mean();
  const double variance = std::max(squares / weight - mean * mean, kLeastSigma * kLeastSigma);
  return -0.5 * ((value - mean) * (value - mean) / variance + std::log(2 * M_PI * variance));
}

void LookStatistics::Cosines::Add(const LookPair& pair, double weight) {
  for (const CueRow& row : kCueRows)
    if (const auto& cue = pair.cues[row.cue]) sides[row.cue][cue->side].Add(cue->cosine, weight);
  if (pair.reversed) (*pair.reversed ? reversed : not_reversed) += weight;
}

LookStatistics LookStatistics::Prior() {
  LookStatistics prior;
  for (const CueRow& row : kCueRows) {
    const CosineStatistics& c = row.cosine;
    prior.same.sides[row.cue] = {LearntNormal::Prior(c.same_side, c.sigma, kPrior),
                                 LearntNormal::Prior(c.opposite_side, c.sigma, kPrior)};
    const LearntNormal other = LearntNormal::Prior(c.other_object, c.sigma, kPrior);
    prior.other.sides[row.cue] = {other, other};
  }
  prior.same.reversed = kPrior * kSameReversed;
  prior.same.not_reversed = kPrior * (1 - kSameReversed);
  prior.other.reversed = kPrior * kOtherReversed;
  prior.other.not_reversed = kPrior * (1 - kOtherReversed);
  return prior;
}

double LogSameObject(const LookPair& pair, const LookStatistics& statistics) {
  const auto &same = statistics.same, &other = statistics.other;
  double log_ratio = 0;
  for (const CueRow& row : kCueRows)
    if (const auto& cue = pair.cues[row.cue])
      log_ratio += same.sides[row.cue][cue->side].LogDensity(cue->cosine) -
                   other.sides[row.cue][cue->side].LogDensity(cue->cosine);
  if (pair.reversed) {
    const auto probability = [&](const LookStatistics::Cosines& of) {
      return (*pair.reversed ? of.reversed : of.not_reversed) / (of.reversed + of.not_reversed);
    };
    log_ratio += std::log(probability(same) / probability(other));
  }
  // With probability c the sightings of one of the sessions are not of the object:
  // log((1 - c) ratio + c)
  constexpr double kMost = 50;  // against overflow [nats]
  const double strange = kStrange / (1 + pair.sightings);
  return std::log((1 - strange) * std::exp(std::min(log_ratio, kMost)) + strange);
}

}  // namespace sslcd
