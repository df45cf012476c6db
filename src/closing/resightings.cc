// SPDX-License-Identifier: BSD-3-Clause
#include "closing/resightings.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace sslcd {
namespace {

// Least path between the sightings of a pass that are compared, and the most, beyond which wrong
// matches are common. Set by hand. [m]
constexpr double kApart = 3, kFarthest = 40;
// Least factors: the tails of what is learnt are not known below. Set by hand.
constexpr double kLeastFactor = 0.1, kLeastTilt = 0.01;

// Noise of the steps of a path, whose variances add up: without the floors, which are of any two
// frames.
OdometryNoise WithoutFloors(OdometryNoise noise) {
  noise.translation_floor_m = noise.rotation_floor_rad = 0;
  return noise;
}

// Without failures.
OdometrySigmas SigmasOfStep(const FrameStore& frames, int to, const OdometryNoise& walk) {
  return SigmasOf(frames[to - 1].T_odom_cam.inverse() * frames[to].T_odom_cam, walk);
}

// Of the failures in a step.
OdometrySigmas FailuresOfStep(const FrameStore& frames, int to) {
  const OdometryFailures failures = FailuresBetween(frames, to - 1, to);
  const double metres = std::sqrt(failures.translation_m2);
  return {metres, metres, std::sqrt(failures.rotation_rad2)};
}

// Sums of the variances of the steps up to a frame, and of those of the rotations times the first
// and second powers of the camera's position [forward, left; m].
struct StepSums {
  double horizontal = 0, vertical = 0, rotation = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
};

// `sigmas_of`: of the step to a frame.
std::vector<StepSums> SumSteps(const FrameStore& frames, const Eigen::Matrix3d& to_layout,
                               double scale, const std::function<OdometrySigmas(int)>& sigmas_of) {
  std::vector<StepSums> sums(frames.size());
  for (int f = 1; f < frames.size(); ++f) {
    const OdometrySigmas sigmas = sigmas_of(f);
    const Eigen::Vector2d c = (scale * (to_layout * frames[f].T_odom_cam.translation())).head<2>();
    const double rotation = sigmas.rotation * sigmas.rotation;
    StepSums& sum = sums[f] = sums[f - 1];
    sum.horizontal += sigmas.horizontal * sigmas.horizontal;
    sum.vertical += sigmas.vertical * sigmas.vertical;
    sum.rotation += rotation;
    sum.first += rotation * c;
    sum.second += rotation * c * c.transpose();
  }
  return sums;
}

// Covariance of the place of any point by the errors of the positions from `a` to `b`.
Eigen::Matrix3d ByPositions(const StepSums& a, const StepSums& b) {
  const double horizontal = b.horizontal - a.horizontal;
  return Vec3(horizontal, horizontal, b.vertical - a.vertical).asDiagonal();
}

// Covariance of the place of a point p by the errors of the rotations from `a` to `b`. A yaw of phi
// at the camera c moves p by phi times p - c turned by 90 degrees, roll and pitch raise it by
// phi |p - c|.
Eigen::Matrix3d ByRotations(const StepSums& a, const StepSums& b, const Eigen::Vector2d& p,
                            double tilt_factor) {
  const Eigen::Vector2d first = b.first - a.first;
  const Eigen::Matrix2d arms = (b.rotation - a.rotation) * p * p.transpose() -
                               p * first.transpose() - first * p.transpose() + b.second - a.second;
  Eigen::Matrix2d quarter_turn;
  quarter_turn << 0, -1, 1, 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.topLeftCorner<2, 2>() = quarter_turn * arms * quarter_turn.transpose();
  covariance(2, 2) = tilt_factor * tilt_factor * arms.trace();
  return covariance;
}

}  // namespace

double LargestTiltFactor(const FrameStore& frames, const Vec3& up, const OdometryNoise& noise) {
  const OdometryNoise walk = WithoutFloors(noise);
  const Vec3 up_in_cam = frames.front().T_odom_cam.so3().inverse() * up;
  double reported = 0, expected = 0, variance = 0;
  for (int f = 1; f < frames.size(); ++f) {
    if (frames[f].sequence != frames[f - 1].sequence) {  // upright again
      variance = 0;
      continue;
    }
    const double sigma = SigmasOfStep(frames, f, walk).rotation;
    variance += sigma * sigma;
    reported += (frames[f].T_odom_cam.so3() * up_in_cam).cross(up).squaredNorm();
    expected += 2 * variance;  // of roll and pitch
  }
  return expected > 0 ? std::sqrt(reported / expected) : 1;
}

std::vector<Resighting> ResightingsOf(const MapState& state, const PassMap& passes,
                                      const OdometryNoise& noise, double scale,
                                      double tilt_factor) {
  const FrameStore& frames = state.frames;
  const Eigen::Matrix3d to_layout = state.gravity().Basis().transpose();
  const OdometryNoise walk = WithoutFloors(noise);
  const std::vector<StepSums> sums =
      SumSteps(frames, to_layout, scale, [&](int f) { return SigmasOfStep(frames, f, walk); });
  const std::vector<StepSums> failed =
      SumSteps(frames, to_layout, scale, [&](int f) { return FailuresOfStep(frames, f); });
  // Place by odometry alone; adds the covariance of the detection.
  const auto place = [&](const std::pair<int, int>& sighting, Eigen::Matrix3d& covariance) {
    const FrameRecord& frame = frames[sighting.first];
    const Vec3 p = frame.detections[sighting.second].T_cam_object.translation();
    const Eigen::Matrix3d R = to_layout * frame.T_odom_cam.so3().matrix();
    covariance += R * PositionCovariance(p, SigmasAt(p.norm(), passes.noise(), {})) * R.transpose();
    return Vec3(scale * (to_layout * frame.T_odom_cam.translation()) + R * p);
  };
  std::vector<Resighting> all;
  for (const PassObject& pass : passes.passes()) {
    const auto& first = pass.sightings.front();
    const double first_m = frames[first.first].travelled;
    double last_m = first_m;
    for (const auto& later : pass.sightings) {
      const double now_m = frames[later.first].travelled;
      if (now_m - last_m < kApart || now_m - first_m > kFarthest) continue;
      last_m = now_m;
      Resighting& both = all.emplace_back();
      both.detection.setZero();
      const Vec3 before = place(first, both.detection), now = place(later, both.detection);
      both.moved = now - before;
      const Eigen::Vector2d middle = 0.5 * (before + now).head<2>();
      const auto by_rotations = [&](const std::vector<StepSums>& steps) {
        return ByRotations(steps[first.first], steps[later.first], middle, tilt_factor);
      };
      both.translation = ByPositions(sums[first.first], sums[later.first]);
      both.rotation = by_rotations(sums);
      // Failures are no multiple of the noise, except for height and tilt (FactorsWithFailures).
      const Eigen::Matrix3d jumped =
          ByPositions(failed[first.first], failed[later.first]) + by_rotations(failed);
      both.fixed = jumped.topLeftCorner<2, 2>();
      both.translation(2, 2) += jumped(2, 2);
    }
  }
  return all;
}

OdometryFactors LearnOdometryInSight(const MapState& state, const PassMap& passes,
                                     const OdometryNoise& noise, double scale,
                                     const OdometryFactors& before) {
  const double tilt = std::clamp(
      kCaution * LargestTiltFactor(state.frames, state.gravity().up, noise), kLeastTilt, 1.);
  OdometryFactors factors = FactorsFromResightings(
      ResightingsOf(state, passes, noise, scale, tilt),
      {before.horizontal / kCaution, before.heading / kCaution, before.vertical / kCaution});
  for (double* factor : {&factors.horizontal, &factors.heading, &factors.vertical})
    *factor = std::max(kLeastFactor, kCaution * *factor);
  factors.tilt = tilt * factors.vertical;
  return factors;
}

}  // namespace sslcd
