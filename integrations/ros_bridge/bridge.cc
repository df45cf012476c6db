// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/bridge.h"

#include <cmath>
#include <iterator>
#include <utility>

#include "ros_bridge/convert.h"
#include "sslcd/core/error.h"

namespace sslcd::ros_bridge {
namespace {

// Axes of a camera (right, down, forward) in those of a body (forward, left, up).
Pose BodyToCamera() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return Pose(lie::SO3<double>::FromMatrix(R), Vec3::Zero());
}

const BridgeOptions& Checked(const BridgeOptions& options) {
  const std::vector<std::string> problems = Check(options);
  if (problems.empty()) return options;
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + problem;
  throw Error(ErrorKind::kBadConfig, text);
}

}  // namespace

std::vector<std::string> Check(const BridgeOptions& options) {
  std::vector<std::string> problems;
  const auto positive = [&](const char* name, double value, bool may_be_zero) {
    if (!(value > 0 || (may_be_zero && value == 0)) || !std::isfinite(value))
      problems.push_back(std::string(name) + " is " + std::to_string(value) + ", must be " +
                         (may_be_zero ? "at least 0" : "above 0"));
  };
  positive("max_gap_s", options.max_gap_s, false);
  positive("buffer_s", options.buffer_s, false);
  positive("min_interval_s", options.min_interval_s, true);
  positive("most_waiting", options.most_waiting, false);
  positive("most_frames", options.most_frames, false);
  if (!(options.lost_variance > 0)) problems.push_back("lost_variance must be above 0");
  return problems;
}

Bridge::Bridge(const BridgeOptions& options, const Options& mapper, const MapperContext& context)
    : options_(Checked(options)),
      odom_frame_(FrameName(options.odom_frame)),
      base_frame_(FrameName(options.base_frame)),
      camera_frame_(FrameName(options.camera_frame)),
      poses_(options.buffer_s, options.max_gap_s),
      mapper_(mapper, context, options.most_frames) {}

void Bridge::Add(const TransformMessage& transform) {
  const std::optional<Pose> T_parent_child = ToPose(transform.pose);
  if (!T_parent_child || !transforms_.Add(transform.parent, transform.child, *T_parent_child))
    drops_.Count(Drop::kTransform);
}

bool Bridge::IsOfThisOdometry(const OdometryMessage& odometry) {
  const std::string frame = FrameName(odometry.frame), child = FrameName(odometry.child_frame);
  if (odom_frame_.empty()) odom_frame_ = frame;
  if (base_frame_.empty()) base_frame_ = child;
  return frame == odom_frame_ && child == base_frame_;
}

void Bridge::Add(const OdometryMessage& odometry) {
  const std::optional<Pose> T_odom_base = ToPose(odometry.pose);
  const OdometryQuality quality = QualityOf(odometry, options_.lost_variance);
  // a lost odometry often has a pose that is none
  if (!T_odom_base && quality != OdometryQuality::kLost)
    return drops_.Count(Drop::kOdometryUnusable);
  if (!IsOfThisOdometry(odometry)) return drops_.Count(Drop::kOdometryOtherFrame);
  if (quality == OdometryQuality::kBadCovariance) drops_.Count(Drop::kCovarianceUnusable);
  if (quality == OdometryQuality::kLost) {
    poses_.Break();
    lost_ = true;
    return drops_.Count(Drop::kOdometryLost);
  }
  PoseBuffer::Added added = poses_.Add(odometry.stamp, *T_odom_base);
  if (added == PoseBuffer::Added::kJumpsBack) {
    StartSequence();
    added = poses_.Add(odometry.stamp, *T_odom_base);
  }
  if (added == PoseBuffer::Added::kDuplicate) return drops_.Count(Drop::kOdometryDuplicate);
  if (added == PoseBuffer::Added::kOutOfOrder) return drops_.Count(Drop::kOdometryOutOfOrder);
  MakeFrames();
}

void Bridge::Add(const DetectionsMessage& detections) {
  if ((last_frame_ && detections.stamp <= *last_frame_) ||
      !waiting_.emplace(detections.stamp, detections).second)
    return drops_.Count(Drop::kDetectionsOutOfOrder);
  MakeFrames();
  if (static_cast<int>(waiting_.size()) <= options_.most_waiting) return;
  // The newest goes: if its clock is ahead of the odometry's, those before it would never come up.
  waiting_.erase(std::prev(waiting_.end()));
  drops_.Count(Drop::kDetectionsWaited);
}

void Bridge::StartSequence() {
  drops_.Count(Drop::kDetectionsAtRestart, static_cast<int>(waiting_.size()));
  waiting_.clear();
  poses_.Clear();
  last_frame_.reset();
  lost_ = false;
  first_of_sequence_ = next_index_;
  T_map_odom_.reset();
  mapper_.StartSequence();
}

void Bridge::MakeFrames() {
  while (!waiting_.empty()) {
    const auto oldest = waiting_.begin();
    const PoseBuffer::Answer at = poses_.At(oldest->first);
    if (at.found == PoseBuffer::Found::kNotYet) return;
    if (at.found == PoseBuffer::Found::kYes)
      MakeFrame(oldest->second, at.T_odom_base);
    else
      drops_.Count(Drop::kDetectionsWithoutOdometry);
    waiting_.erase(oldest);
  }
}

std::optional<Pose> Bridge::BaseToCamera(const std::string& frame) {
  const std::string& camera = camera_frame_.empty() ? frame : camera_frame_;
  const std::optional<Pose> T_base_cam = transforms_.Find(base_frame_, camera);
  if (T_base_cam) camera_frame_ = FrameName(camera);  // not before: the first frame may be wrong
  if (!T_base_cam || !options_.body_axes) return T_base_cam;
  return *T_base_cam * BodyToCamera();
}

void Bridge::MakeFrame(const DetectionsMessage& detections, const Pose& T_odom_base) {
  if (last_frame_ && Seconds(detections.stamp - *last_frame_) < options_.min_interval_s)
    return drops_.Count(Drop::kDetectionsTooSoon);
  const std::optional<Pose> T_base_cam = BaseToCamera(detections.frame);
  const std::optional<Pose> T_base_frame = transforms_.Find(base_frame_, detections.frame);
  if (!T_base_cam || !T_base_frame) return drops_.Count(Drop::kDetectionsOtherFrame);
  T_base_cam_ = *T_base_cam;
  Frame frame;
  frame.index = next_index_++;
  frame.stamp = Seconds(detections.stamp);
  frame.T_odom_cam = T_odom_base * *T_base_cam;
  if (std::exchange(lost_, false)) frame.step = StepUncertainty{true};
  const Pose T_cam_frame = T_base_cam->inverse() * *T_base_frame;
  for (const DetectionMessage& message : detections.detections) {
    std::optional<Detection> detection = ToDetection(message, T_cam_frame);
    if (!detection) {
      drops_.Count(Drop::kObject);
      continue;
    }
    detection->row = static_cast<int>(frame.detections.size());
    frame.detections.push_back(std::move(*detection));
  }
  last_frame_ = detections.stamp;
  stamps_[frame.index] = detections.stamp;
  mapper_.AddFrame(std::move(frame));  // if it is dropped, the report says so
}

LoopEdge Bridge::EdgeOf(const LoopClosure& loop) const {
  LoopEdge edge;
  edge.id = loop.id;
  edge.accepted = loop.decision == LoopDecision::kAccepted;
  edge.early = loop.early;
  edge.match_frame = loop.match_frame;
  edge.query_frame = loop.query_frame;
  edge.match = stamps_.at(loop.match_frame);
  edge.query = stamps_.at(loop.query_frame);
  edge.measured = BetweenBases(loop, T_base_cam_);
  return edge;
}

BridgeReport Bridge::Take() {
  const AsyncReport taken = mapper_.TakeReport();
  drops_.Count(Drop::kFrameQueueFull, taken.dropped);
  drops_.Count(Drop::kFrameRefused, taken.refused);
  BridgeReport report;
  report.frames = taken.frames;
  report.failure = taken.failure;
  std::vector<LoopEdge> changed;
  for (const LoopClosure& loop : taken.changes.loops) changed.push_back(EdgeOf(loop));
  report.loops = Update(changed, loops_);
  const std::vector<FramePose>& poses = taken.changes.poses;
  if (poses.empty()) return report;
  report.path_changed = true;
  for (const FramePose& pose : poses) path_[pose.frame] = pose.T_world_cam * T_base_cam_.inverse();
  // frames of the sequence before may still be in work
  if (poses.back().frame >= first_of_sequence_) T_map_odom_ = taken.changes.T_world_odom;
  return report;
}

std::vector<PathPose> Bridge::path() const {
  std::vector<PathPose> path;
  path.reserve(path_.size());
  for (const auto& [index, T_map_base] : path_)
    path.push_back({index, stamps_.at(index), T_map_base});
  return path;
}

}  // namespace sslcd::ros_bridge
