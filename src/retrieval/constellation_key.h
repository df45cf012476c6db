// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "retrieval/constellation.h"

namespace sslcd {

/// The cell of a constellation in the space of its coordinates and labels.
struct ConstellationKey {
  std::uint64_t cell = 0;    ///< hash of coordinates, in steps of metres, and labels
  std::uint32_t inside = 0;  ///< the place in the cell: 4 bits for each coordinate
};

ConstellationKey KeyOf(const Constellation& one);

/// A cell in which the index may have the same objects.
struct Probe {
  std::uint64_t cell = 0;
  std::uint16_t offsets = 0;  ///< from the own cell: 2 bits for each coordinate; 0: below, 2: above
  float cost = 0;             ///< how improbable it is, against the most probable cell [nats]
};

inline constexpr int kDifferenceSteps = 8;

/// A constellation that is searched in an index.
class SearchedConstellation {
 public:
  explicit SearchedConstellation(const Constellation& one);

  const Constellation& constellation() const { return one_; }

  /// Appends the cells around it whose cost is at most `most_cost`.
  void AppendProbes(float most_cost, std::vector<Probe>& probes) const;

  /// Squared distance of a constellation in a cell, over the noise, in steps of 1/kDifferenceSteps:
  /// about 8 if both are the same objects. Stops above `most`, a number of steps.
  int Difference(std::uint16_t offsets, std::uint32_t inside, int most) const {
    int sum = 0;
    for (int i = 0; i < kCoordinates && sum <= most; i += kCoordinates / 2)
      for (int k = i; k < i + kCoordinates / 2; ++k)
        sum += difference_[k][offsets >> 2 * k & 3][inside >> 4 * k & 15];
    return sum;
  }

 private:
  Constellation one_;
  std::array<int, kCoordinates> cell_{};
  std::array<float, kCoordinates> inside_{};      // in [0, 1)
  std::uint8_t difference_[kCoordinates][4][16];  // by offset and place in the cell
};

}  // namespace sslcd
