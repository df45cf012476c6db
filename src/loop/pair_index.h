// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/layout.h"

namespace sslcd {

/// Two objects of a layout, labels ascending.
struct ObjectPair {
  int a = 0, b = 0;      ///< indices
  float distance = 0;    ///< horizontal [m]
  float dx = 0, dy = 0;  ///< unit vector from a to b
  float dz = 0;          ///< height of b over a [m]
};

/// Finds pairs of objects at different places that are at most `max_pair_m` apart, in a
/// deterministic order. Stops after `most` pairs. A sweep along the longer side of the layout: O(n
/// log n + pairs in a strip of that width).
std::vector<ObjectPair> FindPairs(const std::vector<LayoutObject>& objects, double max_pair_m,
                                  std::size_t most);

/// Pairs of objects by labels and distance.
class PairIndex {
 public:
  PairIndex() = default;
  /// `found` has pairs of `objects`, at most `max_pair_m` apart. O(objects + pairs).
  PairIndex(const std::vector<LayoutObject>& objects, const std::vector<ObjectPair>& found,
            double max_pair_m);

  struct Range {
    std::vector<ObjectPair>::const_iterator first, last;
    std::vector<ObjectPair>::const_iterator begin() const { return first; }
    std::vector<ObjectPair>::const_iterator end() const { return last; }
    bool empty() const { return first == last; }
  };
  /// Pairs of two labels (label_a <= label_b) whose distance may lie in [from_m, to_m]: a superset,
  /// by bins; with more than 256 labels, rare ones may share a list.
  Range Between(int label_a, int label_b, double from_m, double to_m) const;

 private:
  int LabelRank(int label) const;
  int Slot(int rank_a, int rank_b, double distance_m) const;

  std::vector<int> labels_;  // ascending
  int bins_ = 0;             // of distance
  std::vector<int> start_;   // start of each slot (label, label, distance) in pairs_
  std::vector<ObjectPair> pairs_;
};

}  // namespace sslcd
