// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "layout_cases.h"
#include "loop/pose_tracks.h"

namespace sslcd {

inline const YawShift kPose{2.5, {30, -20, 1.5}};

inline PosePrior NoPrior(const YawShift&, const LayoutFit&) { return {}; }

/// A map, and attempts to find parts of it.
struct Attempts {
  LayoutMatchOptions match;
  std::vector<LayoutObject> map;
  LayoutIndex index;
  PoseTracks tracks;
  double map_end_m = std::numeric_limits<double>::infinity();

  explicit Attempts(std::vector<LayoutObject> objects, const PoseTrackOptions& options = {})
      : map(std::move(objects)),
        index(Numbered(map), match.max_pair_m, match.reach_m),
        tracks(options) {}

  static const std::vector<LayoutObject>& Numbered(std::vector<LayoutObject>& objects) {
    for (std::size_t i = 0; i < objects.size(); ++i) objects[i].id = static_cast<int>(i);
    return objects;
  }
  std::vector<LayoutObject> SeenAt(double x, double y, double radius_m = 18) const {
    return SeenFrom(map, kPose, {x, y}, radius_m, 0.1, 2);
  }
  void Update(const std::vector<LayoutObject>& local, double path_m,
              const PoseTracks::Prior& prior = NoPrior) {
    const LayoutLikelihood likelihood(local, index, match.likelihood);
    tracks.Update(likelihood, SearchPoses(likelihood, match.search), match.search, path_m,
                  map_end_m, prior);
  }
  void UpdateWithoutSearch(const std::vector<LayoutObject>& local, double path_m) {
    tracks.Update(LayoutLikelihood(local, index, match.likelihood), {}, match.search, path_m,
                  map_end_m, NoPrior);
  }
};

}  // namespace sslcd
