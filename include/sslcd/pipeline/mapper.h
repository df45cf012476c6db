// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/timing.h"
#include "sslcd/core/trajectory.h"
#include "sslcd/map/object_map.h"
#include "sslcd/optim/object_ba.h"
#include "sslcd/pipeline/options.h"
#include "sslcd/pipeline/place_matcher.h"
#include "sslcd/pipeline/view_aligner.h"

namespace sslcd {

/// What the mapper has to know about the world and the sensor before the first frame.
struct MapperContext {
  GravityFrame gravity;
  LabelTable labels;
  std::optional<Camera> camera;  ///< none: nothing is projected, the box cue drops out
  PlaceMatcher place_matcher{};  ///< none: sslcd's own
  ViewAligner view_aligner{};    ///< none: loops are measured by their objects alone
};

/// What one frame did.
struct FrameReport {
  Pose T_world_cam;
  FilterReport filter;  ///< what became of its detections
  MapUpdate map;
  bool keyframe = false;
  BaSummary window;  ///< of the sliding window; not usable where none ran
};

/// A frame as the mapper remembers it.
struct FrameRecord {
  int frame = 0;
  double stamp = 0;
  double travelled = 0;  ///< path of the odometry so far [m]
  Pose T_odom_cam;       ///< levelled, see LevelOptions
  Pose T_world_cam;
  std::vector<Detection> detections;  ///< after the filter, without appearance vectors
  std::vector<LandmarkId> matched;    ///< landmark of each detection
};

/// Two cameras whose images have been aligned: indices of frames.
struct ViewTie {
  int from = 0, to = 0;
  RelativePose pose;  ///< T_from_to
};

class Leveller;
class LoopCloser;

/// The streaming facade: frames in, a map of objects and a corrected trajectory out (paper III).
/// The world is the odometry's frame, made metric: the first camera stays where the odometry has
/// it. Not thread-safe; one mapper per sequence.
class Mapper {
 public:
  Mapper(const Options& options, const MapperContext& context);
  ~Mapper();

  /// Frames in order of time. O(window), whatever the size of the map, but for attempts to close a
  /// loop. Throws Error(kBadInput) on a stamp that does not increase or a pose that is not finite;
  /// the mapper is then as it was before.
  FrameReport AddFrame(const Frame& frame);

  /// Full-map optimisation over all frames so far: poses, landmarks and scale move, and accepted
  /// loops are measured anew. With a ViewAligner images of different passes are aligned, and all is
  /// optimised once more with that. May be called any time, and again.
  BaSummary Refine();

  const ObjectMap& map() const { return map_; }
  const std::vector<FrameRecord>& frames() const { return frames_; }
  Trajectory CameraTrajectory() const;     ///< one pose a frame
  std::vector<MapObject> Objects() const;  ///< every landmark, by id
  /// every attempt, refused ones too
  std::vector<LoopClosure> LoopClosures() const;
  const std::vector<ViewTie>& view_ties() const { return view_ties_; }  ///< of the last Refine
  /// metres per odometry metre
  double scale() const;
  TimingTable& timing() { return timing_; }

 private:
  Pose Predict(const Pose& T_odom_cam) const;
  bool IsKeyframe(const Pose& T_odom_cam) const;
  BaSummary OptimiseWindow();
  void SlideWindow(const BaProblem& problem);
  BaProblem WindowProblem() const;
  void ResetWindow();
  void Propagate(std::size_t from_record);

  Options options_;
  MapperContext context_;
  ObjectMap map_;
  std::vector<FrameRecord> frames_;
  std::vector<int> window_;  // the keyframes in it: indices into frames_
  BaPrior prior_;
  double log_scale_ = 0;
  std::vector<ViewTie> view_ties_;
  double refined_log_scale_ = 0;  // what the last full-map optimisation found
  TimingTable timing_;
  std::unique_ptr<Leveller> leveller_;
  std::unique_ptr<LoopCloser> loops_;
};

}  // namespace sslcd
