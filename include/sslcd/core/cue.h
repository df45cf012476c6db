// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

/// An appearance cue: a vector of unit length per detection, whose dot product (cosine) measures
/// the similarity of two objects. CONTRIBUTING.md describes how to add one.
enum class Cue {
  kColour,     ///< histogram h of the paper (III-A.2), see perception/colour.h
  kEmbedding,  ///< re-identification vector e of the paper (III-A.3), see detectors/embedder.h
  kCount,      ///< the number of cues, not a cue
};
inline constexpr std::size_t kCueCount = static_cast<std::size_t>(Cue::kCount);

/// Statistics of the cosines of the same object and of different objects. The mean for the same
/// object decreases with the angle between the two views.
struct CosineStatistics {
  double same_side = 1;      ///< mean for one object, seen from one side
  double opposite_side = 1;  ///< mean for one object, seen from opposite sides
  double other_object = 0;   ///< mean for different objects
  double sigma = 1;          ///< standard deviation about each of these means
};

/// The properties of one cue.
struct CueRow {
  Cue cue;
  const char* name;  ///< used in messages
  const char* file;  ///< file in a sequence folder (docs/formats.md)
  /// the file has a vector for every detection; false: detections without one have a row of zeros
  bool complete;
  double (*weight)(double lambda);  ///< weight in the association score, Eq. 3
  CosineStatistics cosine;          ///< the default of AppearanceOptions::cosine
  /// limit of the evidence of this cue, share of AppearanceOptions::limit; none: only the sum of
  /// all cues is limited
  std::optional<double> limit_share;
};

/// The table of cues, in the order of the enum. All figures were set by hand. Colours are those of
/// ColourOptions::Method::kRobust. They change with the light, so their evidence is limited. Their
/// file must be complete, since the reader would fill gaps from images with vectors of another
/// kind.
inline constexpr CueRow kCueRows[] = {
    {Cue::kColour,
     "colour",
     "colours.npy",
     true,
     [](double lambda) { return lambda * (1 - lambda); },  // of Eq. 5
     {0.85, 0.85, 0.6, 0.2},
     1. / 3},
    {Cue::kEmbedding,
     "embedding",
     "embeddings.npy",
     false,
     [](double lambda) { return (1 - lambda) * (1 - lambda); },  // of Eq. 6
     {0.75, 0.45, 0.3, 0.12},
     std::nullopt},
};

/// Whether the rows are in the order of the enum, one per cue.
template <std::size_t kRows>
constexpr bool OneRowPerCue(const CueRow (&rows)[kRows]) {
  for (std::size_t i = 0; i < kRows; ++i)
    if (rows[i].cue != static_cast<Cue>(i)) return false;
  return kRows == kCueCount;
}
static_assert(OneRowPerCue(kCueRows), "each cue needs a row of kCueRows, in the order of the enum");

/// An array of one T per cue.
template <class T>
class PerCue {
 public:
  constexpr PerCue() : values_() {}
  explicit PerCue(const T& each) { values_.fill(each); }

  constexpr T& operator[](Cue cue) { return values_[static_cast<std::size_t>(cue)]; }
  constexpr const T& operator[](Cue cue) const { return values_[static_cast<std::size_t>(cue)]; }

  friend bool operator==(const PerCue& a, const PerCue& b) { return a.values_ == b.values_; }
  friend bool operator!=(const PerCue& a, const PerCue& b) { return !(a == b); }

 private:
  std::array<T, kCueCount> values_;
};

}  // namespace sslcd
