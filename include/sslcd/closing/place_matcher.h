// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "sslcd/core/layout.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// What is asked at each attempt to close a loop: do the objects seen lately lie somewhere among
/// those of older passes? Both lists are in the world's gravity-aligned axes as the trajectory
/// stands now, so they differ by the drift; heights are those over the camera.
struct PlaceQuery {
  const std::vector<LayoutObject>&local, &global;
  int frame = 0;      ///< number of the newest frame
  int old_frame = 0;  ///< number of the newest frame that the global map knows
};

/// Where a matcher finds the place. Either from objects (`matches`: index of local, of global;
/// those that agree with each other), or from two images (`match_frame`, `T_match_query` of the
/// query's newest frame). What two images say is an edge of the pose graph and nothing more: bundle
/// adjustment, which sees objects only, would undo it and has to be off (refine.enabled: false,
/// loop.adjust_keyframes: 0).
struct PlaceAnswer {
  std::vector<std::pair<int, int>> matches{};
  int match_frame = -1;
  Pose T_match_query{};
  double score = 0;       ///< higher is surer
  bool accepted = false;  ///< sure enough, by the matcher's own rule, to close a loop
};

/// Takes the place of sslcd's own matching and belief (MapperContext::place_matcher): for
/// comparison, or to try another idea. None: nothing found. Called at every attempt, in order; at
/// the end (Mapper::Refine) several times about the newest frame, to tie several cameras. What it
/// throws ends the run, and so does an answer that names an object or a frame that there is not
/// (Error, kUsage).
using PlaceMatcher = std::function<std::optional<PlaceAnswer>(const PlaceQuery&)>;

}  // namespace sslcd
