// SPDX-License-Identifier: BSD-3-Clause
#include "closing/mean_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sslcd {

std::optional<MeanSighting> MeanPlace(const PassObject& pass, const MapState& state,
                                      const DetectionNoise& noise, const PathRange& range) {
  const FrameStore& frames = state.frames;
  const GravityFrame& gravity = state.gravity();
  const Vec3 up_in_cam = frames.front().T_world_cam.so3().inverse() * gravity.up;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Vec3 weighted = Vec3::Zero();
  std::vector<Vec2> headings;
  headings.reserve(pass.sightings.size());
  double path = 0;
  double nearest = std::numeric_limits<double>::infinity();
  Pose T_cam_world;  // of the nearest camera
  for (const auto& [f, d] : pass.sightings) {
    const FrameRecord& frame = frames[f];
    if (frame.travelled < range.from_m || frame.travelled > range.to_m) continue;
    const Pose& T_cam_object = frame.detections[d].T_cam_object;
    const Vec3 p = T_cam_object.translation();
    const Eigen::Matrix3d R = frame.T_world_cam.so3().matrix();
    const DetectionSigmas sigmas = SigmasAt(p.norm(), noise, {});
    const Eigen::Matrix3d I = R * PositionInformation(p, sigmas) * R.transpose();
    information += I;
    path += frame.travelled;
    if (p.norm() < nearest) {
      nearest = p.norm();
      T_cam_world = frame.T_world_cam.inverse();
    }
    weighted += I * (frame.T_world_cam * p);
    const Vec3 forward = T_cam_object.so3() * Vec3(Vec3::UnitX());
    headings.push_back(Horizontal(R * forward, gravity).normalized());
  }
  if (static_cast<int>(headings.size()) < std::max(1, range.min_sightings)) return std::nullopt;
  Vec2 axis(0, 0);  // of doubled angles, since headings may be reversed
  for (const Vec2& u : headings) axis += Vec2(u.x() * u.x() - u.y() * u.y(), 2 * u.x() * u.y());
  const Vec3 position = information.ldlt().solve(weighted);
  return MeanSighting{{position, VoteHeading(0.5 * std::atan2(axis.y(), axis.x()), headings)},
                      (T_cam_world * position).dot(up_in_cam),
                      path / static_cast<double>(headings.size())};
}

}  // namespace sslcd
