// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/layout.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// The query of an attempt to close a loop: find the recently seen objects (`local`) among those of
/// older passes (`global`). Both lists are in the same gravity-aligned axes, so they differ by the
/// drift. These axes are the mapper's own: only what is relative between objects has a meaning
/// outside, and Mapper::Objects() has their poses in the host's world. Heights are relative to the
/// camera.
struct PlaceQuery {
  const std::vector<LayoutObject>&local, &global;
  int frame = 0;      ///< number of the newest frame
  int old_frame = 0;  ///< number of the newest frame of the global map
};

/// The answer of a matcher. It comes either from objects (`matches`: consistent pairs of indices
/// into local and global) or from two images (`match_frame`, and `T_match_query` of the query's
/// newest frame). An answer from images is only an edge of the pose graph. Bundle adjustment, which
/// knows only objects, would undo it and must be off (refine.enabled: false, loop.adjust_keyframes:
/// 0).
struct PlaceAnswer {
  std::vector<std::pair<int, int>> matches{};
  int match_frame = -1;   ///< number of the old frame; -1: the answer has `matches`
  Pose T_match_query{};   ///< pose of the query camera in the match camera's frame
  double score = 0;       ///< higher is more certain
  bool accepted = false;  ///< the matcher's decision to close a loop
};

/// Replaces sslcd's matching and acceptance (MapperContext::place_matcher), for comparisons or
/// other methods. None: no place found. Runs at every attempt, in order, and at the end
/// (Mapper::Refine) several times for the newest frame, to tie several cameras. Its exceptions end
/// the run. An answer with an unknown object or frame throws Error(kUsage).
using PlaceMatcher = std::function<std::optional<PlaceAnswer>(const PlaceQuery&)>;

}  // namespace sslcd
