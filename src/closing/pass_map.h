// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "association/gallery.h"
#include "map/map_state.h"
#include "sslcd/core/cue.h"
#include "sslcd/core/layout.h"

namespace sslcd {

/// One landmark on one pass: its sightings between two long path segments without any. A landmark
/// that was recognised on a later pass has several passes. Loop closure matches passes instead of
/// landmarks, which measures the drift between them even if the map has fused their landmarks.
struct PassObject {
  LandmarkId id;
  double first_m = 0, last_m = 0;              ///< path length at its first and last sighting
  std::vector<std::pair<int, int>> sightings;  ///< index of the frame and of the detection in it
  /// frame that a finished pass moves with; -1: not finished
  int anchor = -1;
  /// pose of the object on this pass, which moves with the anchor
  Pose T_anchor_object;
  double height_m = 0;         ///< height over the camera nearest to it
  PerCue<Gallery> appearance;  ///< what it looked like on this pass
};

/// The objects of a layout with their poses in the world, in the same order. The height of a layout
/// object is relative to the camera nearest to it, so that odometry drift of height and tilt
/// cancels.
struct PassLayout {
  std::vector<LayoutObject> objects;
  std::vector<UprightPose> places;
  std::vector<double> seen_m;  ///< mean path length of the sightings of the last pass
};

/// The changes of the objects that PassMap::Before lists.
struct LayoutChanges {
  /// everything may have changed; `objects` is the complete list
  bool all = false;
  std::vector<LayoutObject> objects;  ///< changed objects with current values, by id
  std::vector<int> gone;              ///< ids that may have been listed before and are not any more
};

struct MeanSighting;

/// The passes of a run and their layouts. Has no references: each call gets the map and the frames.
/// Copyable.
class PassMap {
 public:
  /// The state of a reader of ChangesBefore at its last call.
  struct Mark {
    int generation = -1;  ///< -1: no call yet
    FrameStore::Revision revision = 0;
    std::size_t journal = 0;
    double to_m = 0;
  };

  /// A landmark that was out of sight for more than `split_m` of path starts a new pass.
  PassMap(const DetectionNoise& noise, double split_m,
          Gallery::Mode galleries = Gallery::Mode::kByViewpoint)
      : noise_(noise), split_m_(split_m), galleries_(galleries) {}

  /// Adds the newest frame of `state`. `seen` has its detections with appearance, which the frame
  /// does not keep.
  void AddFrame(const MapState& state, const std::vector<Detection>& seen);

  /// Rebuilds all passes from the frames, e.g. after a new association. A pass gets the appearance
  /// of the previous passes that it mostly consists of.
  void Rebuild(const MapState& state);

  /// Updates the ids of fused landmarks. `merged` maps merged ids to their landmarks.
  void Rename(const std::map<int, LandmarkId>& merged);

  /// Objects with at least `min_sightings` sightings in a range of the path, at the mean place of
  /// these sightings.
  PassLayout Between(const MapState& state, double from_m, double to_m, int min_sightings) const;

  /// The same from `from_m` on.
  PassLayout Recent(const MapState& state, double from_m, int min_sightings) const {
    return Between(state, from_m, std::numeric_limits<double>::infinity(), min_sightings);
  }

  /// Objects with passes that ended before `to_m` of path, one entry per object.
  PassLayout Before(const MapState& state, double to_m, int min_sightings) const;

  /// The changes of Before(state, to_m, min_sightings) since `mark`, which is updated. Use each
  /// mark with one value of `min_sightings`. O(sightings and finished passes since then); O(passes)
  /// if everything has moved.
  LayoutChanges ChangesBefore(const MapState& state, double to_m, int min_sightings,
                              Mark& mark) const;

  /// The mean place of a landmark over the passes that ended before `to_m`; none without such a
  /// pass.
  std::optional<UprightPose> PlaceBefore(const MapState& state, LandmarkId id, double to_m,
                                         int min_sightings) const;

  /// Indices of the passes of a landmark, ascending.
  const std::vector<int>& PassesOf(LandmarkId id) const;

  /// The path length of a landmark's finished pass that is nearest to `path_m`. [m]
  double NearestPass(const FrameStore& frames, LandmarkId id, double path_m) const;

  const std::vector<PassObject>& passes() const { return passes_; }

 private:
  struct Sum;
  void Take(const FrameRecord& frame, int index, const std::vector<Detection>& seen,
            const MapState& state);
  void FinishOld(const MapState& state);
  void Finish(const MapState& state, PassObject& pass);
  std::optional<Sum> SumBefore(const MapState& state, int id, double to_m, int min_sightings) const;
  void AppendBefore(const MapState& state, int id, double to_m, int min_sightings,
                    PassLayout& layout) const;
  void Append(const MapState& state, LandmarkId id, const MeanSighting& place,
              const PerCue<Gallery>& appearance, PassLayout& layout) const;
  int LabelNumber(const std::string& label) const;

  DetectionNoise noise_;
  double split_m_;
  Gallery::Mode galleries_;
  std::vector<PassObject> passes_;
  std::map<int, std::vector<int>> passes_of_;  // indices of passes by landmark
  std::map<int, int> open_;                    // current pass by landmark
  mutable std::map<std::string, int> labels_;  // number by label, assigned on first use
  int generation_ = 0;                         // number of rebuilds
  std::vector<int> journal_;  // landmarks whose passes have ended or were renamed, in order of time
};

}  // namespace sslcd
