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

/// One landmark on one pass: its sightings between two long stretches without any. A landmark that
/// was recognised on a later pass has several of these. Loop closure matches passes rather than
/// landmarks: that tells how far the odometry has drifted in between, also where the map has long
/// fused what both have seen.
struct PassObject {
  LandmarkId id;
  double first_m = 0, last_m = 0;              ///< path travelled at its first and last sighting
  std::vector<std::pair<int, int>> sightings;  ///< index of the frame, index of the detection in it
  /// the frame that a finished pass is tied to; -1: not finished yet
  int anchor = -1;
  /// where the pass puts the object; it moves with its anchor
  Pose T_anchor_object;
  double height_m = 0;         ///< over the camera that saw it from nearest
  PerCue<Gallery> appearance;  ///< what it looked like on this pass
};

/// Objects as matching sees them, and where they are in the world, in step. The height of a layout
/// object is that over the camera that saw it from nearest: odometry's drift in height and tilt
/// cancels.
struct PassLayout {
  std::vector<LayoutObject> objects;
  std::vector<UprightPose> places;
  std::vector<double> seen_m;  ///< where on the path, on average; of the last pass
};

/// What has happened to the objects that PassMap::Before lists.
struct LayoutChanges {
  bool all = false;                   ///< anything may have changed: `objects` are all there are
  std::vector<LayoutObject> objects;  ///< as they are now, by id
  std::vector<int> gone;              ///< ids that may have been listed before and no longer are
};

struct MeanSighting;

/// The passes of a run and the layouts they make. Holds no reference: the map and the frames whose
/// passes these are go into each call. Copyable.
class PassMap {
 public:
  /// Where a reader of ChangesBefore was at its last call.
  struct Mark {
    int generation = -1;  ///< none: everything is new
    FrameStore::Revision revision = 0;
    std::size_t journal = 0;
    double to_m = 0;
  };

  /// A landmark out of sight for more path than `split_m` is on another pass when it comes back.
  PassMap(const DetectionNoise& noise, double split_m,
          Gallery::Mode galleries = Gallery::Mode::kByViewpoint)
      : noise_(noise), split_m_(split_m), galleries_(galleries) {}

  /// Takes in the newest frame of `state`. `seen`: its detections with their appearance, which the
  /// frame itself does not keep.
  void AddFrame(const MapState& state, const std::vector<Detection>& seen);

  /// Starts again from what the frames say now, e.g. after everything was associated again. A pass
  /// takes its appearance over from the former passes it mostly consists of.
  void Rebuild(const MapState& state);

  /// Landmarks were fused: ids that are gone -> the landmarks they were merged into.
  void Rename(const std::map<int, LandmarkId>& merged);

  /// Objects seen at least `min_sightings` times between two points of the path, where those
  /// sightings put them.
  PassLayout Between(const MapState& state, double from_m, double to_m, int min_sightings) const;

  /// The same from `from_m` on.
  PassLayout Recent(const MapState& state, double from_m, int min_sightings) const {
    return Between(state, from_m, std::numeric_limits<double>::infinity(), min_sightings);
  }

  /// Objects by their passes that ended before `to_m` of path, one each.
  PassLayout Before(const MapState& state, double to_m, int min_sightings) const;

  /// What has changed in Before(state, to_m, min_sightings) since `mark`, which moves on to now;
  /// one mark goes with one `min_sightings`. O(what was seen since then, and what has become old);
  /// O(passes) if everything has moved.
  LayoutChanges ChangesBefore(const MapState& state, double to_m, int min_sightings,
                              Mark& mark) const;

  /// Where the passes that ended before `to_m` put a landmark; none if there is no such pass.
  std::optional<UprightPose> PlaceBefore(const MapState& state, LandmarkId id, double to_m,
                                         int min_sightings) const;

  /// Indices of the passes of a landmark, ascending.
  const std::vector<int>& PassesOf(LandmarkId id) const;

  /// Where on the path a landmark was seen on that one of its finished passes that is nearest to
  /// `path_m`. [m]
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
  std::map<int, std::vector<int>> passes_of_;  // landmark -> indices of its passes
  std::map<int, int> open_;                    // landmark -> its present pass
  mutable std::map<std::string, int> labels_;  // numbers of labels, given on first use
  int generation_ = 0;                         // how often everything was rebuilt
  std::vector<int> journal_;  // landmarks whose passes have ended or were renamed, as it happened
};

}  // namespace sslcd
