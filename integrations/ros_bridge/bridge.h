// SPDX-License-Identifier: BSD-3-Clause
// Messages in, corrections out: pairs detections with the odometry at their stamp, hands frames to
// a mapper on a thread of its own, and gives back what a node publishes. Knows no ROS.
#pragma once

#include <future>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ros_bridge/drops.h"
#include "ros_bridge/loop_edges.h"
#include "ros_bridge/messages.h"
#include "ros_bridge/pose_buffer.h"
#include "ros_bridge/static_transforms.h"
#include "sslcd/pipeline/async_mapper.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::ros_bridge {

struct BridgeOptions {
  /// empty: those of the first odometry message
  std::string odom_frame, base_frame;
  /// the frame whose axes are those of a camera: x right, y down, z forward. Empty: that of the
  /// first detections whose frame a transform joins with the base
  std::string camera_frame;
  /// camera_frame has the axes of a body (x forward, y left, z up), e.g. a LiDAR's
  bool body_axes = false;
  double max_gap_s = 0.5;        ///< longest gap of the odometry that is interpolated
  double buffer_s = 10;          ///< odometry that is kept
  double min_interval_s = 0.09;  ///< between two frames; detections nearer in time are left out
  int most_waiting = 50;         ///< detections that wait for odometry
  int most_frames = 64;          ///< frames that wait for the mapper
  /// odometry with variances of x and y from here on was lost, as RTAB-Map says it. [m^2]
  double lost_variance = 9999;
};

/// Problems of the options, one sentence each. Empty: they are valid.
std::vector<std::string> Check(const BridgeOptions& options);

/// A pose of the base in the map.
struct PathPose {
  int frame = 0;  ///< increases, also over sequences
  Stamp stamp = 0;
  Pose T_map_base;
};

/// What is new.
struct BridgeReport {
  int frames = 0;               ///< mapped since the last report
  bool path_changed = false;    ///< see Bridge::path()
  std::vector<LoopEdge> loops;  ///< accepted, measured again or taken back
  std::string failure;          ///< the mapper has ended, and why
};

/// Not thread-safe: one thread makes all calls. None waits for the mapper but Wait().
class Bridge {
 public:
  /// Throws Error(kBadConfig) with all problems, and what AsyncMapper throws.
  Bridge(const BridgeOptions& options, const Options& mapper, const MapperContext& context);

  /// What cannot be used is counted in drops().
  void Add(const TransformMessage& transform);
  /// A stamp that goes back by more than max_gap_s begins a new sequence.
  void Add(const OdometryMessage& odometry);
  void Add(const DetectionsMessage& detections);
  /// The odometry restarts: see Mapper::StartSequence.
  void StartSequence();
  void Refine() { mapper_.Refine(); }

  BridgeReport Take();
  /// Corrects the odometry. None: no frame of this sequence has been mapped yet.
  const std::optional<Pose>& T_map_odom() const { return T_map_odom_; }
  /// Of all frames so far, corrected.
  std::vector<PathPose> path() const;
  /// Accepted loops by id, corrected.
  const std::map<int, LoopEdge>& loops() const { return loops_; }
  /// Stamp of the newest odometry.
  std::optional<Stamp> newest_odometry() const { return poses_.newest(); }
  const Drops& drops() const { return drops_; }
  /// Empty: not known yet.
  const std::string& odom_frame() const { return odom_frame_; }
  const std::string& base_frame() const { return base_frame_; }
  const std::string& camera_frame() const { return camera_frame_; }
  /// Asks for a copy of the mapper, e.g. for its map. It comes when the mapper gets to it.
  std::future<Mapper> Snapshot() { return mapper_.Snapshot(); }
  /// Waits until all frames so far are mapped.
  void Wait() { mapper_.Wait(); }

 private:
  bool IsOfThisOdometry(const OdometryMessage& odometry);
  void MakeFrames();
  void MakeFrame(const DetectionsMessage& detections, const Pose& T_odom_base);
  std::optional<Pose> BaseToCamera(const std::string& frame);
  LoopEdge EdgeOf(const LoopClosure& loop) const;

  const BridgeOptions options_;
  std::string odom_frame_, base_frame_, camera_frame_;
  StaticTransforms transforms_;
  PoseBuffer poses_;
  std::map<Stamp, DetectionsMessage> waiting_;
  std::optional<Stamp> last_frame_;  // of this sequence
  bool lost_ = false;                // since the last frame
  int next_index_ = 0, first_of_sequence_ = 0;
  std::map<int, Stamp> stamps_;  // of all frames, by index
  std::map<int, Pose> path_;     // T_map_base by index
  std::map<int, LoopEdge> loops_;
  Pose T_base_cam_;
  std::optional<Pose> T_map_odom_;
  Drops drops_;
  AsyncMapper mapper_;  // the last member: it ends first
};

}  // namespace sslcd::ros_bridge
