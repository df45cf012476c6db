// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "closing/pass_layout.h"
#include "closing/pass_map.h"
#include "loop/layout_index.h"
#include "sslcd/closing/options.h"

namespace sslcd {

/// The global map of an attempt: an index of the objects of passes that ended before a point of the
/// path. Updates incrementally from call to call. Copyable.
class GlobalLayout {
 public:
  explicit GlobalLayout(const LoopOptions& options)
      : max_pair_m_(options.match.max_pair_m),
        reach_m_(options.match.reach_m),
        min_sightings_(options.layout.min_sightings) {}

  /// Updates and returns the index, which is valid until the next call. O(changes); O(map) if
  /// everything has changed.
  const LayoutIndex& Update(const MapState& state, const PassMap& passes, double global_end_m);

 private:
  double max_pair_m_, reach_m_;
  int min_sightings_;
  PassLayouts::Mark mark_;
  std::optional<LayoutIndex> index_;
};

}  // namespace sslcd
