// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "association/gallery.h"
#include "core/silhouette.h"
#include "sslcd/core/cue.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/export.h"
#include "sslcd/core/label.h"
#include "sslcd/core/landmark.h"

namespace sslcd {

/// A frame of a map.
struct HistoryFrame {
  int number = 0;    ///< in the map
  int session = 0;   ///< 0, 1, 2, ...
  int map = 0;       ///< MapPart::joined_with of its part
  double stamp = 0;  ///< [s]
  Pose T_world_cam;
  std::vector<Detection> detections;
};

/// What a map knows of its objects.
struct HistoryWorld {
  GravityFrame gravity;
  LabelTable labels;
  NoiseScale noise;  ///< learnt, on the default DetectionNoise
  int sessions = 0;
  std::vector<MapObject> objects;
};

/// What is kept of a frame.
struct FrameSightings {
  int session = 0, map = 0;
  double stamp = 0;
  Pose T_world_cam;
  std::vector<int> landmarks;       ///< seen; indices of HistoryWorld::objects
  std::vector<Silhouette> passing;  ///< detections without a landmark
};

/// How an object looked in one session.
struct SessionLooks {
  PerCue<Gallery> views;
  /// detections with the heading of the landmark, and against it
  int ahead = 0, reversed = 0;
  int sightings = 0;

  /// Adds those of another landmark, whose heading differs by `turn_rad`.
  void Merge(const SessionLooks& other, double turn_rad);
};

/// What was seen of a landmark.
struct LandmarkSightings {
  int map = -1;                        ///< of its sightings
  std::vector<int> frames;             ///< ascending
  std::vector<SessionLooks> sessions;  ///< of each session
  /// sum of the information matrices of the position in the world [1/m^2]
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

/// Collects what each session has seen. One AddFrame per frame of the map, in order.
class SSLCD_EXPORT Sightings {
 public:
  explicit Sightings(HistoryWorld world);

  /// O(detections)
  void AddFrame(const HistoryFrame& frame);

  const HistoryWorld& world() const { return world_; }
  const std::vector<LandmarkSightings>& landmarks() const { return landmarks_; }
  const std::vector<FrameSightings>& frames() const { return frames_; }

 private:
  void AddSighting(const HistoryFrame& frame, const Detection& detection, int landmark);

  HistoryWorld world_;
  std::map<std::pair<int, int>, int> landmark_of_;  // frame and row
  std::vector<LandmarkSightings> landmarks_;
  std::vector<FrameSightings> frames_;
};

}  // namespace sslcd
