// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sslcd/bundle/options.h"
#include "sslcd/closing/place_matcher.h"
#include "sslcd/closing/view_aligner.h"
#include "sslcd/core/camera.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/export.h"
#include "sslcd/core/label.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"
#include "sslcd/core/pose_graph.h"
#include "sslcd/map/options.h"
#include "sslcd/perception/filter.h"

namespace SSLCD_EXPORT sslcd {

class LoopFinder;
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

/// The pose of a frame.
struct FramePose {
  int frame = 0;     ///< Frame::index
  double stamp = 0;  ///< [s]
  Pose T_world_cam;
};

/// A part of a run: a stretch of frames between which odometry was never lost, up to the first
/// frame of the next part. A sequence (Mapper::StartSequence) begins a part, a lost step another.
/// Until loops join it with other parts, nothing tells where it is in the map: its poses hold among
/// themselves only. A new sequence stands 5 km beside the map so far, turned as its odometry has
/// it.
struct MapPart {
  int first_frame = 0;  ///< Frame::index
  int sequence = 0;     ///< number of its sequence, from 0 on
  /// the earliest part, by number, that accepted loops join it with, maybe over others; its own
  /// number if there is none. Parts with the same one have a common map. A loop that is taken back
  /// may part them again.
  int joined_with = 0;

  bool operator==(const MapPart& other) const {
    return first_frame == other.first_frame && sequence == other.sequence &&
           joined_with == other.joined_with;
  }
};

/// What has changed since it was last asked for, for hosts that keep a copy of the results.
struct MapChanges {
  /// T_world_cam T_odom_cam^-1 of the newest frame (ROS: map to odom). Corrects the odometry until
  /// the next frame.
  Pose T_world_odom;
  double scale = 1;  ///< Mapper::scale(): for hosts that stay in the odometry's unit
  /// the first frame whose pose has changed, and all frames after it
  std::vector<FramePose> poses;
  /// the attempts that are new, or whose decision or measurement has changed, by
  /// LoopClosure::id: a loop that is taken back, or an early one that has ended, is among them with
  /// its new decision. Landmarks have their current ids; later, see Mapper::Current.
  std::vector<LoopClosure> loops;
  /// all parts, if one is new or joined with others than before; otherwise empty
  std::vector<MapPart> parts;
};

/// The attempts to close a loop so far, and why there are no more loops.
struct LoopSearchSummary {
  int searches = 0;  ///< local maps that were compared with the map
  int accepted = 0;
  /// too few objects in sight or in the map, or no pose brings enough of them together
  int without_candidate = 0;
  std::map<std::string, int> refused;  ///< counts by LoopClosure::reason
  /// false: the cameras turn about another axis than `MapperContext::gravity` says, so objects lie
  /// and nothing is found
  bool up_axis_is_plausible = true;

  /// In a line, e.g. "38 searches, 0 loops accepted; 38: another pose fits nearly as well".
  std::string Text() const;
};

/// A frame that a mapper has got.
struct AddedFrame {
  Frame frame;
  bool starts_sequence = false;  ///< after Mapper::StartSequence
};

/// The result of one frame.
struct FrameReport {
  Pose T_world_cam;       ///< current estimate
  MapChanges changes;     ///< since the report before
  FilterReport filter;    ///< counts of its kept and dropped detections
  MapUpdate map;          ///< changes of the map
  bool keyframe = false;  ///< it is a keyframe of the sliding window
  BaSummary window;       ///< sliding-window adjustment; not usable if none ran
};

/// Whether frames follow a refinement.
enum class Refinement {
  kAtEnd,     ///< none: the latest cameras search for loops, too, with what they have seen so far
  kOnTheWay,  ///< some
};

/// The streaming interface: takes frames and builds a map of objects and a corrected trajectory
/// (paper III). The world is the first sequence's odometry frame with metric scale; its first
/// camera keeps its odometry pose. Not thread-safe.
class Mapper {
 public:
  /// Options: pipeline/options.h. Throws Error(kBadConfig) if they are out of range or contradict
  /// each other, Error(kBadInput) for a camera without focal length or an up axis of no length.
  Mapper(const Options& options, const MapperContext& context);
  ~Mapper();
  /// A copy has its own state, e.g. to run Refine() on another thread while the original adds
  /// frames; see CatchUp. It shares the host's functions (MapperContext). O(frames + map).
  Mapper(const Mapper& other);
  Mapper& operator=(const Mapper& other);
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// Adds the next frame in order of time. O(window) for any size of the map, except for attempts
  /// to close a loop. The detections of a frame whose step is lost are not used, since nothing
  /// tells where they are. Throws Error(kBadInput) and keeps its state if the number or the stamp
  /// does not increase, the pose is not finite, no rotation or absurdly far away, or a standard
  /// deviation of the step is negative or not finite. Counts invalid detections
  /// (FrameReport::filter).
  FrameReport AddFrame(const Frame& frame);

  /// The next frame begins a new sequence on the same map, e.g. after a restart of the odometry, or
  /// on another day. Its stamp and its pose may be any, its number must be above those before.
  /// Nothing is known of the step to it (StepUncertainty::lost), but the up axis and the camera on
  /// the robot are the same. Loops join the sequences, in any order: see Parts(). A first loop to
  /// another sequence takes more evidence than others, since no odometry speaks for it.
  void StartSequence();

  /// What has changed since the last call, or the last frame's report: e.g. by Refine().
  MapChanges TakeChanges();

  /// Optimises poses, landmarks and scale over all frames so far and measures accepted loops again.
  /// With a ViewAligner it also aligns images of different passes and optimises again with these.
  /// Where the result is not surely better than the odometry, horizontally or in height, the
  /// odometry stays (RefineOptions::least_probability); where loops join sequences, only where it
  /// is probably not better. Searches for loops a second time, since the prior is narrow now. May
  /// be called at any time and repeatedly.
  BaSummary Refine(Refinement when = Refinement::kAtEnd);

  /// Makes a refined copy the successor of its original, which has got the frames `since` after the
  /// copy was taken: adds them. TakeChanges() then tells what differs from what the original has
  /// told. Attempts that both have made have the same id, and no other id names anything else than
  /// in the original. O(frames) and the time of AddFrame.
  void CatchUp(const Mapper& original, const std::vector<AddedFrame>& since);

  /// The parts of the run, by number, and which of them have a common map. O(parts + loops)
  std::vector<MapPart> Parts() const;

  const GravityFrame& gravity() const;
  NoiseScale noise_scale() const;          ///< learnt factors on the detector's noise
  Trajectory CameraTrajectory() const;     ///< T_world_cam of each frame
  std::vector<MapObject> Objects() const;  ///< all landmarks, sorted by id
  /// The landmark that an id names now: itself, or the one that it was fused into. None if it was
  /// removed.
  std::optional<LandmarkId> Current(LandmarkId id) const;
  /// all attempts to close a loop, including refused ones, and the early loops
  std::vector<LoopClosure> LoopClosures() const;
  LoopSearchSummary SummariseLoopSearch() const;  ///< O(frames)
  const std::vector<ViewTie>& view_ties() const;  ///< ties of the last Refine()
  ImprovementProbability improvement() const;     ///< by the last Refine()
  /// Frames by their numbers, the metric odometry between them, accepted loops and view ties.
  PoseGraph Graph() const;
  /// metres per odometry metre
  double scale() const;
  TimingTable& timing();  ///< core/timing.h

 private:
  friend class Localiser;
  Mapper(const Options& options, const MapperContext& context, std::unique_ptr<LoopFinder> finder);
  void SearchNow();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
