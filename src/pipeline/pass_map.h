// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/association/gallery.h"
#include "sslcd/core/layout.h"
#include "sslcd/pipeline/mapper.h"

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
  double height_m = 0;        ///< over the camera that saw it from nearest
  Gallery colour, embedding;  ///< what it looked like on this pass
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
  bool anew = false;                  ///< anything may have: `objects` are all there are
  std::vector<LayoutObject> objects;  ///< as they are now, by id
  std::vector<int> gone;              ///< ids that may have been listed before and are not any more
};

/// The passes of a run and the layouts they make. Refers to the mapper's own map and frames.
class PassMap {
 public:
  /// A landmark out of sight for more path than `split_m` is on another pass when it comes back.
  PassMap(const ObjectMap& map, const std::vector<FrameRecord>& frames, const DetectionNoise& noise,
          double split_m, Gallery::Mode galleries = Gallery::Mode::kByViewpoint)
      : map_(map), frames_(frames), noise_(noise), split_m_(split_m), galleries_(galleries) {}

  /// Takes in the frames that were added since the last call, and how their detections look.
  void Update();

  /// Starts again from what the frames say now, e.g. after everything was associated anew. Where
  /// the frames do not know any more how their detections looked, a pass takes that over from the
  /// former ones it mostly consists of.
  void Rebuild();

  /// Landmarks were fused: those that are gone -> those that took them over.
  void Rename(const std::map<int, LandmarkId>& heirs);

  /// Trajectory or detections of the frames from this one on are not what they were; 0: of all.
  void MovedFrom(int frame) {
    moved_from_ = std::min(moved_from_, static_cast<std::size_t>(frame));
  }

  /// Objects seen at least `min_sightings` times between two points of the path, where those
  /// sightings put them.
  PassLayout Between(double from_m, double to_m, int min_sightings) const;

  /// ... since then.
  PassLayout Recent(double from_m, int min_sightings) const {
    return Between(from_m, std::numeric_limits<double>::infinity(), min_sightings);
  }

  /// Objects by their passes that ended before `to_m` of path, one each.
  PassLayout Before(double to_m, int min_sightings) const;

  /// What has changed in Before(to_m, min_sightings) since the last call of this. O(what was seen
  /// since then, and what has become old); O(passes) if everything has moved.
  LayoutChanges ChangesBefore(double to_m, int min_sightings);

  /// Where the passes that ended before `to_m` put a landmark; none if there is no such pass.
  std::optional<UprightPose> PlaceBefore(LandmarkId id, double to_m, int min_sightings) const;

  /// Indices of the passes of a landmark, ascending.
  const std::vector<int>& PassesOf(LandmarkId id) const;

  /// Where on the path a landmark was seen on that one of its finished passes that is nearest to
  /// `path_m`. [m]
  double NearestPass(LandmarkId id, double path_m) const;

  const std::vector<PassObject>& passes() const { return passes_; }

 private:
  struct Sum;
  void Finish(PassObject& pass);
  std::optional<Sum> SumBefore(int id, double to_m, int min_sightings) const;
  void AppendBefore(int id, double to_m, int min_sightings, PassLayout& layout) const;
  void Append(LandmarkId id, const UprightPose& place, double height_m, double seen_m,
              const Gallery& colour, const Gallery& embedding, PassLayout& layout) const;
  std::size_t FrameFrom(double path_m) const;
  void SeenIn(std::size_t from, std::size_t to, std::set<int>& ids) const;

  const ObjectMap& map_;
  const std::vector<FrameRecord>& frames_;
  DetectionNoise noise_;
  double split_m_;
  Gallery::Mode galleries_;
  std::size_t next_frame_ = 0;
  std::vector<PassObject> passes_;
  std::map<int, std::vector<int>> passes_of_;  // landmark -> indices of its passes
  std::map<int, int> open_;                    // landmark -> its present pass
  mutable std::map<std::string, int> labels_;
  // Since the last ChangesBefore:
  double changes_to_m_ = 0;  // its to_m
  int changes_min_sightings_ = 0;
  std::size_t moved_from_ = 0;  // the first frame that may have moved, or come
  std::set<int> touched_;       // landmarks that have changed otherwise
};

}  // namespace sslcd
