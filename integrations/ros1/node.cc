// SPDX-License-Identifier: BSD-3-Clause
#include "node.h"

#include <cstdio>

namespace sslcd::ros1 {
namespace {

constexpr double kPathEvery_s = 1, kLogEvery_s = 5;

// Whether so much time has passed since `last`, which is now then. By the wall's clock: under
// /use_sim_time the other one may stand still.
bool IsTime(double every_s, ros::WallTime& last) {
  const ros::WallTime now = ros::WallTime::now();
  if ((now - last).toSec() < every_s) return false;
  last = now;
  return true;
}

}  // namespace

Node::Node(ros::NodeHandle& node, ros::NodeHandle& own, const Parameters& parameters)
    : parameters_(parameters), bridge_(parameters.bridge, parameters.mapper, parameters.context) {
  tf_ = node.advertise<tf2_msgs::TFMessage>("/tf", 100);
  path_ = own.advertise<nav_msgs::Path>("path", 1, /*latch=*/true);
  map_ = own.advertise<visualization_msgs::MarkerArray>("map", 1, /*latch=*/true);
  transforms_ = node.subscribe("/tf_static", 100, &Node::OnTransforms, this);
  odometry_ = node.subscribe("odom", 1000, &Node::OnOdometry, this);
  detections_ = node.subscribe("detections", 1000, &Node::OnDetections, this);
  using Request = std_srvs::Empty;
  refine_ = own.advertiseService<Request::Request, Request::Response>(
      "refine", [this](Request::Request&, Request::Response&) {
        bridge_.Refine();
        return true;
      });
  restart_ = own.advertiseService<Request::Request, Request::Response>(
      "start_sequence", [this](Request::Request&, Request::Response&) {
        bridge_.StartSequence();
        return true;
      });
  timer_ = node.createWallTimer(ros::WallDuration(0.05),
                                [this](const ros::WallTimerEvent&) { Publish(); });
}

void Node::OnTransforms(const tf2_msgs::TFMessage& message) {
  for (const auto& transform : message.transforms) bridge_.Add(FromRos(transform));
}

void Node::Publish() {
  const ros_bridge::BridgeReport report = bridge_.Take();
  frames_ += report.frames;
  path_is_new_ |= report.path_changed;
  for (const ros_bridge::LoopEdge& loop : report.loops) {
    if (loop.early) continue;  // comes again, as a loop of another id
    ROS_INFO("loop %d %s: %.3f s to %.3f s, %.1f m", loop.id,
             loop.accepted ? "closed" : "taken back", ros_bridge::Seconds(loop.query),
             ros_bridge::Seconds(loop.match), loop.measured.T_a_b.translation().norm());
  }
  PublishCorrection();
  if (path_is_new_ && IsTime(kPathEvery_s, last_path_)) {
    path_.publish(ToRos(bridge_.path(), parameters_.map_frame));
    path_is_new_ = false;
  }
  PublishMap();
  LogDrops();
  if (report.failure.empty()) return;
  failure_ = report.failure;
  ROS_FATAL("the mapper has ended: %s", failure_.c_str());
  ros::requestShutdown();
}

void Node::PublishCorrection() {
  if (!parameters_.publish_tf || !bridge_.T_map_odom() || !bridge_.newest_odometry()) return;
  const ros_bridge::Stamp ahead = static_cast<ros_bridge::Stamp>(1e9 * parameters_.tf_ahead_s);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(ToRos(
      *bridge_.T_map_odom(), HeaderOf(*bridge_.newest_odometry() + ahead, parameters_.map_frame),
      bridge_.odom_frame()));
  tf_.publish(message);
}

// The map is in a copy of the mapper, which comes when the mapper gets to it.
void Node::PublishMap() {
  if (snapshot_.valid()) {
    if (snapshot_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    try {
      const Mapper mapper = snapshot_.get();
      std::vector<ros_bridge::Marker> markers = ros_bridge::ObjectMarkers(mapper.Objects());
      markers.push_back(ros_bridge::LoopMarker(bridge_.path(), bridge_.loops()));
      map_.publish(
          ToRos(markers, HeaderOf(bridge_.newest_odometry().value_or(0), parameters_.map_frame)));
      ROS_INFO_THROTTLE(30, "%d frames, %zu loops; %s", frames_, bridge_.loops().size(),
                        mapper.SummariseLoopSearch().Text().c_str());
    } catch (const std::future_error&) {  // the mapper has ended, and Publish says so
    }
  }
  if (parameters_.map_every_s > 0 && frames_ > 0 && IsTime(parameters_.map_every_s, last_map_))
    snapshot_ = bridge_.Snapshot();
}

void Node::LogDrops() {
  if (bridge_.drops().defects() == defects_ || !IsTime(kLogEvery_s, last_log_)) return;
  defects_ = bridge_.drops().defects();
  ROS_WARN("not used so far: %s (frames: odometry '%s', base '%s', camera '%s')",
           bridge_.drops().Text().c_str(), bridge_.odom_frame().c_str(),
           bridge_.base_frame().c_str(), bridge_.camera_frame().c_str());
}

// ROS logs nothing after its shutdown.
void Node::PrintSummary() const {
  std::printf("[sslcd] %d frames, %zu loops; not used: %s\n", frames_, bridge_.loops().size(),
              bridge_.drops().Text().c_str());
}

}  // namespace sslcd::ros1
