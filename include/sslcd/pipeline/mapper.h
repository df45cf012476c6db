// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sslcd/bundle/options.h"
#include "sslcd/closing/place_matcher.h"
#include "sslcd/closing/view_aligner.h"
#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/label.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"
#include "sslcd/core/pose_graph.h"
#include "sslcd/map/options.h"
#include "sslcd/perception/filter.h"

namespace sslcd {

class TimingTable;
struct Options;

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

/// The streaming facade: frames in, a map of objects and a corrected trajectory out (paper III).
/// The world is the odometry's frame, made metric: the first camera stays where the odometry has
/// it. Not thread-safe; one mapper per sequence.
class Mapper {
 public:
  /// Options: pipeline/options.h
  Mapper(const Options& options, const MapperContext& context);
  ~Mapper();
  /// A copy has all of the state and goes its own way, e.g. to Refine() in a thread of its own
  /// while the original takes in frames. It shares the host's functions (MapperContext). O(frames +
  /// map).
  Mapper(const Mapper& other);
  Mapper& operator=(const Mapper& other);
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// Frames in order of time. O(window), whatever the size of the map, but for attempts to close a
  /// loop. Throws Error(kBadInput) on a stamp that does not increase or a pose that is not finite;
  /// the mapper is then as it was before.
  FrameReport AddFrame(const Frame& frame);

  /// Full-map optimisation over all frames so far: poses, landmarks and scale move, and accepted
  /// loops are measured anew. With a ViewAligner images of different passes are aligned, and all is
  /// optimised once more with that. May be called any time, and again.
  BaSummary Refine();

  const GravityFrame& gravity() const;
  NoiseScale noise_scale() const;          ///< what was learnt of the detector
  Trajectory CameraTrajectory() const;     ///< one pose a frame
  std::vector<MapObject> Objects() const;  ///< every landmark, by id
  /// every attempt, refused ones too
  std::vector<LoopClosure> LoopClosures() const;
  const std::vector<ViewTie>& view_ties() const;  ///< of the last Refine
  /// Frames by their numbers, the metric odometry between them, accepted loops and view ties.
  PoseGraph Graph() const;
  /// metres per odometry metre
  double scale() const;
  TimingTable& timing();  ///< core/timing.h

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
