// SPDX-License-Identifier: BSD-3-Clause
#include "convert_messages.h"

#include <algorithm>

namespace sslcd::ros1 {
namespace {

ros_bridge::RawPose Raw(const geometry_msgs::Pose& pose) {
  const geometry_msgs::Point& position = pose.position;
  const geometry_msgs::Quaternion& q = pose.orientation;
  return {{position.x, position.y, position.z}, {q.x, q.y, q.z, q.w}};
}

ros_bridge::Stamp StampOf(const std_msgs::Header& header) {
  return static_cast<ros_bridge::Stamp>(header.stamp.toNSec());
}

geometry_msgs::Point PointOf(const Vec3& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = point.z();
  return message;
}

visualization_msgs::Marker MarkerOf(const ros_bridge::Marker& marker,
                                    const std_msgs::Header& header) {
  using Message = visualization_msgs::Marker;
  Message message;
  message.header = header;
  message.ns = marker.name_space;
  message.id = marker.id;
  message.type =
      marker.type == ros_bridge::Marker::Type::kCube ? Message::CUBE : Message::LINE_LIST;
  message.pose = ToRos(marker.pose);
  message.scale.x = marker.scale.x();
  message.scale.y = marker.scale.y();
  message.scale.z = marker.scale.z();
  message.color.r = marker.colour[0];
  message.color.g = marker.colour[1];
  message.color.b = marker.colour[2];
  message.color.a = marker.colour[3];
  for (const Vec3& point : marker.points) message.points.push_back(PointOf(point));
  return message;
}

}  // namespace

ros_bridge::OdometryMessage FromRos(const nav_msgs::Odometry& message) {
  ros_bridge::OdometryMessage odometry;
  odometry.stamp = StampOf(message.header);
  odometry.frame = message.header.frame_id;
  odometry.child_frame = message.child_frame_id;
  odometry.pose = Raw(message.pose.pose);
  std::copy(message.pose.covariance.begin(), message.pose.covariance.end(),
            odometry.covariance.begin());
  return odometry;
}

ros_bridge::DetectionsMessage FromRos(const Detection3DArray& message,
                                      const std::vector<std::string>& labels) {
  ros_bridge::DetectionsMessage detections{StampOf(message.header), message.header.frame_id, {}};
  for (const Detection3D& box : message.detections) {
    ros_bridge::DetectionMessage detection;
    detection.pose = Raw(box.center);
    detection.size = {box.size.x, box.size.y, box.size.z};
    for (const ObjectHypothesisWithPose& result : box.results) {
      const bool known = result.id >= 0 && result.id < static_cast<std::int64_t>(labels.size());
      detection.hypotheses.push_back(
          {known ? labels[static_cast<std::size_t>(result.id)] : "", result.score});
    }
    detections.detections.push_back(std::move(detection));
  }
  return detections;
}

ros_bridge::TransformMessage FromRos(const geometry_msgs::TransformStamped& message) {
  const geometry_msgs::Vector3& t = message.transform.translation;
  const geometry_msgs::Quaternion& q = message.transform.rotation;
  return {message.header.frame_id, message.child_frame_id, {{t.x, t.y, t.z}, {q.x, q.y, q.z, q.w}}};
}

std_msgs::Header HeaderOf(ros_bridge::Stamp stamp, const std::string& frame) {
  // ros::Time throws beyond its range
  const ros_bridge::Stamp latest = static_cast<ros_bridge::Stamp>(ros::TIME_MAX.toNSec());
  std_msgs::Header header;
  header.stamp.fromNSec(
      static_cast<std::uint64_t>(std::clamp<ros_bridge::Stamp>(stamp, 0, latest)));
  header.frame_id = frame;
  return header;
}

geometry_msgs::Pose ToRos(const Pose& pose) {
  geometry_msgs::Pose message;
  message.position = PointOf(pose.translation());
  const Eigen::Quaterniond q(pose.so3().matrix());
  message.orientation.x = q.x();
  message.orientation.y = q.y();
  message.orientation.z = q.z();
  message.orientation.w = q.w();
  return message;
}

geometry_msgs::TransformStamped ToRos(const Pose& T_parent_child, const std_msgs::Header& parent,
                                      const std::string& child) {
  geometry_msgs::TransformStamped message;
  message.header = parent;
  message.child_frame_id = child;
  const geometry_msgs::Pose pose = ToRos(T_parent_child);
  message.transform.translation.x = pose.position.x;
  message.transform.translation.y = pose.position.y;
  message.transform.translation.z = pose.position.z;
  message.transform.rotation = pose.orientation;
  return message;
}

nav_msgs::Path ToRos(const std::vector<ros_bridge::PathPose>& path, const std::string& frame) {
  nav_msgs::Path message;
  message.header = HeaderOf(path.empty() ? 0 : path.back().stamp, frame);
  for (const ros_bridge::PathPose& pose : path) {
    geometry_msgs::PoseStamped stamped;
    stamped.header = HeaderOf(pose.stamp, frame);
    stamped.pose = ToRos(pose.T_map_base);
    message.poses.push_back(stamped);
  }
  return message;
}

visualization_msgs::MarkerArray ToRos(const std::vector<ros_bridge::Marker>& markers,
                                      const std_msgs::Header& header) {
  visualization_msgs::MarkerArray message;
  visualization_msgs::Marker all;
  all.header = header;
  all.action = visualization_msgs::Marker::DELETEALL;
  message.markers.push_back(all);
  for (const ros_bridge::Marker& marker : markers)
    message.markers.push_back(MarkerOf(marker, header));
  return message;
}

}  // namespace sslcd::ros1
