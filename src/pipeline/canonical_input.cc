// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/canonical_input.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace sslcd {

Pose StartOf(const Pose& T_odom_cam, const GravityFrame& gravity) {
  constexpr double kVertical = 0.9;  // cosine of the angle to the vertical
  const GravityFrame start;
  const lie::SO3<double> level =
      lie::SO3<double>::FromMatrix(start.Basis() * gravity.Basis().transpose());
  const lie::SO3<double> R_level_cam = level * T_odom_cam.so3();
  Vec3 heading = R_level_cam * Vec3(Vec3::UnitX());
  if (std::abs(heading.dot(start.up)) > kVertical) heading = R_level_cam * Vec3(Vec3::UnitZ());
  const double yaw = std::atan2(heading.dot(start.left), heading.dot(start.forward));
  const lie::SO3<double> turn = lie::SO3<double>::Exp(Vec3(-yaw * start.up)) * level;
  return Pose(turn, Vec3(-(turn * T_odom_cam.translation())));
}

double WholeMicroseconds(double time_s) {
  constexpr double kPerSecond = 1e6, kLongest = 1e9;
  return std::abs(time_s) < kLongest ? std::round(kPerSecond * time_s) / kPerSecond : time_s;
}

std::vector<int> CanonicalOrder(const std::vector<Detection>& detections) {
  const auto key = [&](int i) {
    const Detection& one = detections[i];
    const Vec3& place = one.T_cam_object.translation();
    const Vec6 pose = one.T_cam_object.Log();
    return std::make_tuple(-one.score, place.x(), place.y(), place.z(), pose[3], pose[4], pose[5],
                           one.dims.x(), one.dims.y(), one.dims.z());
  };
  std::vector<int> order(detections.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const auto first = key(a), second = key(b);
    return first != second ? first < second : detections[a].label < detections[b].label;
  });
  return order;
}

std::vector<Detection> InOrder(const std::vector<Detection>& detections,
                               const std::vector<int>& order) {
  std::vector<Detection> sorted;
  for (const int i : order) sorted.push_back(detections[i]);
  return sorted;
}

std::vector<LandmarkId> BackInOrder(const std::vector<LandmarkId>& sorted,
                                    const std::vector<int>& order) {
  std::vector<LandmarkId> matched(sorted.size());
  for (std::size_t i = 0; i < order.size(); ++i) matched[order[i]] = sorted[i];
  return matched;
}

}  // namespace sslcd
