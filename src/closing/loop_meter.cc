// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "closing/local_map_errors.h"

namespace sslcd {
namespace {

// All set by hand without a recorded search. Standard deviation between the headings that two
// passes give one object. [rad]
constexpr double kYawSigma = 0.2;
// Path between two query cameras that are tried if the heading is too uncertain. [m]
constexpr int kCamerasTried = 3;
constexpr double kFurtherBack = 10.;
// Path on either side of a camera over which cameras are upright on average. [m]
constexpr double kLevelReach = 20.;
constexpr double kRoundingTilt = 1e-9;  // a smaller tilt is rounding error [rad]

// Path lengths of the first and the last common object. [m]
std::pair<double, double> SeenBetween(const CommonObjects& common) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const auto& pair : common.pairs) {
    first = std::min(first, common.local.seen_m[pair.first]);
    last = std::max(last, common.local.seen_m[pair.first]);
  }
  return {first, last};
}

}  // namespace

std::vector<std::pair<int, LandmarkId>> OldLandmarks(
    const std::vector<std::pair<int, int>>& matches, const LayoutIndex& global) {
  std::vector<std::pair<int, LandmarkId>> pairs;
  for (const auto& [i, j] : matches) pairs.push_back({i, {global.objects()[j].id}});
  return pairs;
}

LoopMeter::LoopMeter(const CommonObjects& common, const MapState& state, const PassMap& passes,
                     const LoopOptions& options, const OdometryFactors& factors)
    : common_(common),
      frames_(state.frames),
      gravity_(state.gravity()),
      passes_(passes),
      options_(options),
      factors_(factors) {
  for (const auto& [local, old] : common.pairs) pairs_.push_back(PairOf(local, old, state));
  std::tie(first_m_, last_m_) = SeenBetween(common);
}

DriftPair LoopMeter::PairOf(int local, LandmarkId old, const MapState& state) const {
  DriftPair pair;
  pair.T_world_local = ToPose(common_.local.places[local], gravity_);
  const auto place = PassLayouts(passes_, state)
                         .PlaceBefore(old, common_.global_end_m, options_.layout.min_sightings);
  pair.T_world_global = ToPose(place.value(), gravity_);
  pair.symmetry = common_.local.objects[local].symmetry;
  pair.sigma_horizontal_m = pair.sigma_vertical_m = common_.sigma_m;
  pair.sigma_yaw_rad = kYawSigma;
  return pair;
}

std::optional<LoopMeasurement> LoopMeter::Measure(double query_m, double beyond_m) {
  if (!drift_) drift_ = SolveDrift(pairs_, gravity_, options_.drift);
  if (!drift_->usable) return std::nullopt;
  std::optional<LoopMeasurement> best;
  for (int i = 0; i < kCamerasTried; ++i) {
    const int query = frames_.AtPath(
        std::clamp(query_m - kFurtherBack * i, first_m_ - beyond_m, last_m_ + beyond_m));
    const int match = NearestOldFrame(drift_->T_global_local * frames_[query].T_world_cam);
    auto now = MeasureBetween(query, match);
    if (now && (!best || now->heading_sigma < best->heading_sigma)) best = std::move(now);
    if (best && best->heading_sigma < options_.acceptance.max_heading_sigma_rad) break;
  }
  return best;
}

std::optional<LoopMeasurement> LoopMeter::MeasureBetween(int query, int match) const {
  const Pose level_query = LevelFrame(query), level_match = LevelFrame(match);
  std::vector<DriftPair> pairs = pairs_;
  const OdometryModel odometry{options_.odometry, factors_};
  LoopMeasurement loop;
  LoopClosure& row = loop.row;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& [i, old] = common_.pairs[k];
    const double old_seen_m = passes_.NearestPass(frames_, old, frames_[match].travelled);
    const double bent = std::hypot(OdometrySigma(frames_, query, common_.local.seen_m[i], odometry),
                                   OdometrySigma(frames_, match, old_seen_m, odometry));
    pairs[k].sigma_horizontal_m = pairs[k].sigma_vertical_m = std::hypot(common_.sigma_m, bent);
    pairs[k].T_world_local = level_query * pairs[k].T_world_local;
    pairs[k].T_world_global = level_match * pairs[k].T_world_global;
    row.pairs.push_back({{common_.local.objects[i].id}, old});
  }
  const DriftResult drift = SolveDrift(pairs, gravity_, options_.drift);
  if (!drift.usable) return std::nullopt;

  const Pose &T_world_query = frames_[query].T_world_cam,
             &T_world_match = frames_[match].T_world_cam;
  const Pose corrected = level_match.inverse() * drift.T_global_local * level_query * T_world_query;
  loop.query = query;
  loop.match = match;
  row.query_frame = frames_[query].frame;
  row.match_frame = frames_[match].frame;
  row.T_match_query = T_world_match.inverse() * corrected;
  row.viewpoint_change_rad = ViewpointChange(T_world_match, corrected, gravity_);
  const Pose::Matrix6 to_query = (level_query * T_world_query).inverse().Adj();
  Pose::Matrix6 covariance = to_query * Pose::Matrix6(drift.covariance) * to_query.transpose();
  covariance.diagonal().head<3>().array() += options_.sigma_m * options_.sigma_m;
  covariance.diagonal().tail<3>().array() += options_.sigma_rad * options_.sigma_rad;
  const Vec3 up = (level_query * T_world_query).so3().inverse() * gravity_.up;
  loop.heading_sigma = std::sqrt(up.dot(covariance.bottomRightCorner<3, 3>() * up));
  covariance += OdometryBeyond(frames_, query, first_m_, last_m_, up, odometry);
  row.covariance = covariance;
  return loop;
}

// Searches the frames of the passes that saw the matched old objects.
int LoopMeter::NearestOldFrame(const Pose& T_world_cam) const {
  std::pair<double, int> nearest(std::numeric_limits<double>::infinity(), 0);
  for (const auto& pair : common_.pairs)
    for (const int i : passes_.PassesOf(pair.second)) {
      const PassObject& pass = passes_.passes()[i];
      if (pass.last_m >= common_.global_end_m) continue;
      for (int f = pass.sightings.front().first; f <= pass.sightings.back().first; ++f) {
        const Vec3 apart = frames_[f].T_world_cam.translation() - T_world_cam.translation();
        nearest = std::min(nearest, {apart.squaredNorm(), f});
      }
    }
  return nearest.second;
}

// Rotates the world about a camera so that the cameras around it are upright on average.
Pose LoopMeter::LevelFrame(int frame) const {
  const Vec3 up_in_cam = frames_.front().T_world_cam.so3().inverse() * gravity_.up;
  Vec3 up = Vec3::Zero();
  for (const int step : {-1, 1})
    for (int f = frame; f >= 0 && f < frames_.size(); f += step) {
      if (std::abs(frames_[f].travelled - frames_[frame].travelled) > kLevelReach) break;
      up += frames_[f].T_world_cam.so3() * up_in_cam;
    }
  const Vec3 axis = up.cross(gravity_.up);
  if (axis.norm() < kRoundingTilt) return {};
  const auto turn =
      lie::SO3<double>::Exp(Vec3(std::atan2(axis.norm(), up.dot(gravity_.up)) * axis.normalized()));
  const Vec3 pivot = frames_[frame].T_world_cam.translation();
  return {turn, pivot - turn * pivot};
}

double ViewpointChange(const Pose& T_world_a, const Pose& T_world_b, const GravityFrame& gravity) {
  const auto heading = [&](const Pose& T_world_cam) {
    const Vec3 axis = T_world_cam.so3() * Vec3::UnitZ();
    return std::atan2(axis.dot(gravity.left), axis.dot(gravity.forward));
  };
  return std::abs(WrapAngle(heading(T_world_b) - heading(T_world_a)));
}

}  // namespace sslcd
