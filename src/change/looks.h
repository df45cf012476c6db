// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "change/sightings.h"

namespace sslcd {

/// How an object looked in one session against how one looked in another.
struct LookPair {
  struct Similarity {
    double cosine = 0;  ///< mean over all pairs of sightings
    int side = 0;       ///< 0: seen from the same side, 1: from opposite sides
  };
  PerCue<std::optional<Similarity>> cues;
  std::optional<bool> reversed;  ///< front and back have changed
  int sightings = 0;             ///< of the session with fewer
};
/// Compares the views from the same side, if there are any, otherwise those from opposite sides.
/// O(views^2 * length)
LookPair Compare(const SessionLooks& a, const SessionLooks& b, Symmetry symmetry);

/// A normal distribution that is learnt from weighted values.
struct LearntNormal {
  double weight = 0, sum = 0, squares = 0;

  /// As if `weight` values with this mean and standard deviation had been seen.
  static LearntNormal Prior(double mean, double sigma, double weight);
  void Add(double value, double weight);
  double Mean() const { return sum / weight; }
  double LogDensity(double value) const;
};

/// How the looks of one object agree from session to session, and those of different ones.
struct LookStatistics {
  /// of the cosines, by side
  struct Cosines {
    PerCue<std::array<LearntNormal, 2>> sides;
    double reversed = 0, not_reversed = 0;
    void Add(const LookPair& pair, double weight);
  };
  Cosines same, other;

  /// What kCueRows say of the cues.
  static LookStatistics Prior();
};

/// Log likelihood ratio of "the same object" against "another one of the label". Zero if there is
/// nothing to compare.
double LogSameObject(const LookPair& pair, const LookStatistics& statistics);

}  // namespace sslcd
