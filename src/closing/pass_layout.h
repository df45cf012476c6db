// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "closing/mean_place.h"
#include "closing/pass_map.h"
#include "map/map_state.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// The objects of a layout with their poses in the world, in the same order. The height of a layout
/// object is relative to the camera nearest to it, so that odometry drift of height and tilt
/// cancels.
struct PassLayout {
  std::vector<LayoutObject> objects;
  std::vector<UprightPose> places;
  std::vector<double> seen_m;  ///< mean path length of the sightings of the last pass
};

/// The changes of the objects that PassLayouts::Before lists.
struct LayoutChanges {
  /// everything may have changed; `objects` is the complete list
  bool all = false;
  std::vector<LayoutObject> objects;  ///< changed objects with current values, by id
  std::vector<int> gone;              ///< ids that may have been listed before and are not any more
};

/// The layouts that the passes of a run make. Refers to its arguments.
class PassLayouts {
 public:
  /// The state of a reader of ChangesBefore at its last call.
  struct Mark {
    int generation = -1;  ///< -1: no call yet
    FrameStore::Revision revision = 0;
    std::size_t journal = 0;
    double to_m = 0;
  };

  PassLayouts(const PassMap& passes, const MapState& state) : passes_(passes), state_(state) {}

  /// Objects with at least `min_sightings` sightings in a range of the path, at the mean place of
  /// these sightings.
  PassLayout Between(double from_m, double to_m, int min_sightings) const;

  /// The same from `from_m` on.
  PassLayout Recent(double from_m, int min_sightings) const {
    return Between(from_m, std::numeric_limits<double>::infinity(), min_sightings);
  }

  /// Objects with passes that ended before `to_m` of path, one entry per object.
  PassLayout Before(double to_m, int min_sightings) const;

  /// The changes of Before(to_m, min_sightings) since `mark`, which is updated. Use each
  /// mark with one value of `min_sightings`. O(sightings and finished passes since then); O(passes)
  /// if everything has moved.
  LayoutChanges ChangesBefore(double to_m, int min_sightings, Mark& mark) const;

  /// The mean place of a landmark over the passes that ended before `to_m`; none without such a
  /// pass.
  std::optional<UprightPose> PlaceBefore(LandmarkId id, double to_m, int min_sightings) const;

 private:
  struct Sum;
  std::optional<Sum> SumBefore(int id, double to_m, int min_sightings) const;
  void AppendBefore(int id, double to_m, int min_sightings, PassLayout& layout) const;
  void Append(LandmarkId id, const MeanSighting& place, const PerCue<Gallery>& appearance,
              PassLayout& layout) const;

  const PassMap& passes_;
  const MapState& state_;
};

}  // namespace sslcd
