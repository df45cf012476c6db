// SPDX-License-Identifier: BSD-3-Clause
// vision_msgs/Detection3DArray of ROS 1 (vision_msgs 0.0.1, as in Melodic and Noetic), for reading.
// Debian has no vision_msgs; with these traits a node takes the message of any publisher without
// the package. smoke_test.py holds the checksum against genpy's.
#pragma once

#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/Vector3.h>
#include <ros/serialization.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <vector>

namespace sslcd::ros1 {

struct ObjectHypothesisWithPose {
  std::int64_t id = 0;  ///< number of the class
  double score = 0;
  geometry_msgs::PoseWithCovariance pose;
};

struct Detection3D {
  std_msgs::Header header;
  std::vector<ObjectHypothesisWithPose> results;
  geometry_msgs::Pose center;   ///< bbox.center
  geometry_msgs::Vector3 size;  ///< bbox.size
  sensor_msgs::PointCloud2 source_cloud;
};

struct Detection3DArray {
  std_msgs::Header header;
  std::vector<Detection3D> detections;
};

}  // namespace sslcd::ros1

namespace ros {
namespace message_traits {

template <>
struct IsMessage<sslcd::ros1::Detection3DArray> : TrueType {};
template <>
struct HasHeader<sslcd::ros1::Detection3DArray> : TrueType {};
template <>
struct MD5Sum<sslcd::ros1::Detection3DArray> {
  static const char* value() { return "05c51d9aea1fb4cfdc8effb94f197b6f"; }
  static const char* value(const sslcd::ros1::Detection3DArray&) { return value(); }
};
template <>
struct DataType<sslcd::ros1::Detection3DArray> {
  static const char* value() { return "vision_msgs/Detection3DArray"; }
  static const char* value(const sslcd::ros1::Detection3DArray&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<sslcd::ros1::ObjectHypothesisWithPose> {
  template <typename Stream, typename T>
  static void allInOne(Stream& stream, T message) {
    stream.next(message.id);
    stream.next(message.score);
    stream.next(message.pose);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

template <>
struct Serializer<sslcd::ros1::Detection3D> {
  template <typename Stream, typename T>
  static void allInOne(Stream& stream, T message) {
    stream.next(message.header);
    stream.next(message.results);
    stream.next(message.center);
    stream.next(message.size);
    stream.next(message.source_cloud);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

template <>
struct Serializer<sslcd::ros1::Detection3DArray> {
  template <typename Stream, typename T>
  static void allInOne(Stream& stream, T message) {
    stream.next(message.header);
    stream.next(message.detections);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization
}  // namespace ros
