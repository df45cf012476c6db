// SPDX-License-Identifier: BSD-3-Clause
#include "closing/local_map_errors.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

// Typical range of an object, by which a rotation of the odometry moves it. Set by hand. [m]
constexpr double kSeenFrom = 10.;

}  // namespace

double OdometrySigma(const FrameStore& frames, int frame, double seen_m,
                     const OdometryModel& odometry) {
  const int seen = frames.AtPath(seen_m);
  const OdometrySigmas sigmas = SigmasBetween(frames, frame, seen, odometry.noise);
  const double step =
      (frames[frame].T_odom_cam.translation() - frames[seen].T_odom_cam.translation()).norm();
  // The local map is short, and the caution of the factors is for long paths.
  OdometryFactors factors;
  factors.horizontal = std::min(1., odometry.factors.horizontal);
  factors.heading = std::min(1., odometry.factors.heading);
  factors = FactorsWithFailures(factors, sigmas);
  return std::hypot(factors.horizontal * sigmas.horizontal,
                    factors.heading * sigmas.rotation * (0.5 * step + kSeenFrom));
}

Pose::Matrix6 OdometryBeyond(const FrameStore& frames, int query, double first_m, double last_m,
                             const Vec3& up, const OdometryModel& odometry) {
  const int in_sight = frames.AtPath(std::clamp(frames[query].travelled, first_m, last_m));
  if (query == in_sight) return Pose::Matrix6::Zero();
  return InformationOf(SigmasBetween(frames, in_sight, query, odometry.noise), up, odometry.factors)
      .inverse();
}

}  // namespace sslcd
