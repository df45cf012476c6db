// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/convert.h"

#include <algorithm>
#include <cmath>

namespace sslcd::ros_bridge {
namespace {

bool IsVariance(double value) { return std::isfinite(value) && value >= 0; }

}  // namespace

std::optional<Pose> ToPose(const RawPose& raw) {
  const Eigen::Map<const Eigen::Vector3d> position(raw.position.data());
  const Eigen::Map<const Eigen::Vector4d> xyzw(raw.orientation.data());
  if (!position.allFinite() || !(std::abs(xyzw.norm() - 1) <= kRotationTolerance)) return {};
  const Eigen::Quaterniond q(xyzw);
  return Pose::FromQuaternionTranslation(q.normalized(), position);
}

OdometryQuality QualityOf(const OdometryMessage& odometry, double lost_variance) {
  const auto variance = [&](std::size_t i) { return odometry.covariance[7 * i]; };
  for (std::size_t i = 0; i < 6; ++i)
    if (!IsVariance(variance(i))) return OdometryQuality::kBadCovariance;
  // not z: odometry of wheels does not measure it, and says so with a huge variance
  const bool lost = variance(0) >= lost_variance && variance(1) >= lost_variance;
  return lost ? OdometryQuality::kLost : OdometryQuality::kGood;
}

std::optional<Detection> ToDetection(const DetectionMessage& message, const Pose& T_cam_frame) {
  const auto best =
      std::max_element(message.hypotheses.begin(), message.hypotheses.end(),
                       [](const Hypothesis& a, const Hypothesis& b) { return a.score < b.score; });
  if (best == message.hypotheses.end() || best->label.empty()) return {};
  if (!(best->score >= 0 && best->score <= 1)) return {};
  for (const double side : message.size)
    if (!(side > 0 && std::isfinite(side))) return {};
  const std::optional<Pose> T_frame_object = ToPose(message.pose);
  if (!T_frame_object) return {};
  Detection detection;
  detection.label = best->label;
  detection.score = best->score;
  detection.T_cam_object = T_cam_frame * *T_frame_object;
  detection.dims = Vec3(message.size[0], message.size[1], message.size[2]);
  return detection;
}

RelativePose BetweenBases(const LoopClosure& loop, const Pose& T_base_cam) {
  // T_base_cam T_match_query Exp(d) T_cam_base, with the inverse drawn to the left of Exp
  const Pose T_match_query = T_base_cam * loop.T_match_query * T_base_cam.inverse();
  const Pose::Matrix6 adjoint = T_base_cam.Adj();
  return {T_match_query, adjoint * loop.covariance * adjoint.transpose()};
}

}  // namespace sslcd::ros_bridge
