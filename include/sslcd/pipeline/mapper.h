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

/// The world and the sensor of a mapper, known before the first frame.
struct MapperContext {
  GravityFrame gravity;  ///< of the odometry's world
  LabelTable labels;
  std::optional<Camera> camera;  ///< none: association does not use 2D boxes
  PlaceMatcher place_matcher{};  ///< none: sslcd's own
  ViewAligner view_aligner{};    ///< none: only objects measure loops
};

/// The result of one frame.
struct FrameReport {
  Pose T_world_cam;       ///< current estimate
  FilterReport filter;    ///< counts of its kept and dropped detections
  MapUpdate map;          ///< changes of the map
  bool keyframe = false;  ///< it is a keyframe of the sliding window
  BaSummary window;       ///< sliding-window adjustment; not usable if none ran
};

/// The streaming interface: takes frames and builds a map of objects and a corrected trajectory
/// (paper III). The world is the odometry's frame with metric scale; the first camera keeps its
/// odometry pose. Use one mapper per sequence; it is not thread-safe.
class Mapper {
 public:
  /// Options: pipeline/options.h
  Mapper(const Options& options, const MapperContext& context);
  ~Mapper();
  /// A copy has its own state, e.g. to run Refine() on another thread while the original adds
  /// frames. It shares the host's functions (MapperContext). O(frames + map).
  Mapper(const Mapper& other);
  Mapper& operator=(const Mapper& other);
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// Adds the next frame in order of time. O(window) for any size of the map, except for attempts
  /// to close a loop. The detections of a frame whose step is lost are not used, since nothing
  /// tells where they are. Throws Error(kBadInput) and keeps its state if the stamp does not
  /// increase, the pose is not finite, or a standard deviation of the step is negative or not
  /// finite.
  FrameReport AddFrame(const Frame& frame);

  /// Optimises poses, landmarks and scale over all frames so far and measures accepted loops again.
  /// With a ViewAligner it also aligns images of different passes and optimises again with these.
  /// Where the result is not surely better than the odometry, horizontally or in height, the
  /// odometry stays (RefineOptions::least_probability); the next frame continues the optimised
  /// trajectory all the same. May be called at any time and repeatedly.
  BaSummary Refine();

  const GravityFrame& gravity() const;
  NoiseScale noise_scale() const;          ///< learnt factors on the detector's noise
  Trajectory CameraTrajectory() const;     ///< T_world_cam of each frame
  std::vector<MapObject> Objects() const;  ///< all landmarks, sorted by id
  /// all attempts to close a loop, including refused ones
  std::vector<LoopClosure> LoopClosures() const;
  const std::vector<ViewTie>& view_ties() const;  ///< ties of the last Refine()
  ImprovementProbability improvement() const;     ///< by the last Refine()
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
