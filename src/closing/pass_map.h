// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "association/gallery.h"
#include "map/map_state.h"
#include "sslcd/core/cue.h"

namespace sslcd {

/// One landmark on one pass: its sightings between two long path segments without any. A landmark
/// that was recognised on a later pass has several passes. Loop closure matches passes instead of
/// landmarks, which measures the drift between them even if the map has fused their landmarks.
struct PassObject {
  LandmarkId id;
  LandmarkId own_id;                           ///< the landmark that it was before any fusion
  double first_m = 0, last_m = 0;              ///< path length at its first and last sighting
  std::vector<std::pair<int, int>> sightings;  ///< index of the frame and of the detection in it
  /// frame that a finished pass moves with; -1: not finished
  int anchor = -1;
  /// pose of the object on this pass, which moves with the anchor
  Pose T_anchor_object;
  double height_m = 0;         ///< height over the camera nearest to it
  PerCue<Gallery> appearance;  ///< what it looked like on this pass
};

/// The passes of a run. Has no references: each call gets the map and the frames. Copyable.
class PassMap {
 public:
  /// A landmark that was out of sight for more than `split_m` of path starts a new pass.
  PassMap(const DetectionNoise& noise, double split_m,
          Gallery::Mode galleries = Gallery::Mode::kByViewpoint)
      : noise_(noise), split_m_(split_m), galleries_(galleries) {}

  /// Adds the newest frame of `state`. `seen` has its detections with appearance, which the frame
  /// does not keep.
  void AddFrame(const MapState& state, const std::vector<Detection>& seen);

  /// Rebuilds all passes from the frames, e.g. after a new association. A pass gets the appearance
  /// of the previous passes that it mostly consists of, and the own id of most of its sightings.
  void Rebuild(const MapState& state);

  /// Updates the ids of fused landmarks. `merged` maps merged ids to their landmarks.
  void Rename(const std::map<int, LandmarkId>& merged);

  /// Indices of the passes of a landmark, ascending.
  const std::vector<int>& PassesOf(LandmarkId id) const;

  /// The sighting of a landmark that is nearest to `path_m`: index of the frame and of the
  /// detection in it.
  std::optional<std::pair<int, int>> NearestSighting(const FrameStore& frames, LandmarkId id,
                                                     double path_m) const;

  /// The path length of a landmark's finished pass that is nearest to `path_m`. [m]
  double NearestPass(const FrameStore& frames, LandmarkId id, double path_m) const;

  const std::vector<PassObject>& passes() const { return passes_; }
  /// Indices of the passes of all landmarks, by id.
  const std::map<int, std::vector<int>>& passes_of() const { return passes_of_; }
  const DetectionNoise& noise() const { return noise_; }
  Gallery::Mode galleries() const { return galleries_; }

  /// The number of a label, the same for as long as the map lives.
  int LabelNumber(const std::string& label) const;

  /// Number of rebuilds, after which nothing that was computed before holds.
  int generation() const { return generation_; }
  /// Landmarks whose passes have ended or were renamed, in order of time.
  const std::vector<int>& journal() const { return journal_; }

 private:
  void Take(const FrameRecord& frame, int index, const std::vector<Detection>& seen,
            const MapState& state);
  void InheritFrom(const std::vector<PassObject>& before);
  void FinishOld(const MapState& state);
  void Finish(const MapState& state, PassObject& pass);

  DetectionNoise noise_;
  double split_m_;
  Gallery::Mode galleries_;
  std::vector<PassObject> passes_;
  std::map<int, std::vector<int>> passes_of_;  // indices of passes by landmark
  std::map<int, int> open_;                    // current pass by landmark
  mutable std::map<std::string, int> labels_;  // number by label, assigned on first use
  int generation_ = 0;
  std::vector<int> journal_;
};

}  // namespace sslcd
