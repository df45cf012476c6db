// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry_failures.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

// A step is a jump if it exceeds the longest of the last kSteps ones by this factor, at least by
// this length or angle. Frames may be dropped, and a camera may start quickly. Set by hand.
constexpr std::size_t kSteps = 51, kFewestSteps = 5;
constexpr double kFactor = 8, kLeastMetres = 3, kLeastRad = 1.5;

// Standard deviations of a lost step: larger than most maps, and any turn. Loops outweigh them.
constexpr double kLostMetres = 1000, kLostRad = M_PI;

OdometryFailures Reported(const StepUncertainty& step) {
  if (step.lost) return {kLostMetres * kLostMetres, kLostRad * kLostRad, 1};
  return {step.translation_m * step.translation_m, step.rotation_rad * step.rotation_rad, 0};
}

}  // namespace

OdometryFailures StepJudge::Judge(double metres, double rad) const {
  if (last_.size() < kFewestSteps) return {};
  Step longest{kLeastMetres / kFactor, kLeastRad / kFactor};
  for (const Step& step : last_) {
    longest.metres = std::max(longest.metres, step.metres);
    longest.rad = std::max(longest.rad, step.rad);
  }
  OdometryFailures failures;
  if (metres > kFactor * longest.metres) failures.translation_m2 = metres * metres;
  if (rad > kFactor * longest.rad) failures.rotation_rad2 = rad * rad;
  return failures;
}

OdometryFailures StepJudge::Add(const Pose& T_odom_cam,
                                const std::optional<StepUncertainty>& reported) {
  if (!before_) {
    before_ = T_odom_cam;
    return {};
  }
  const Pose step = before_->inverse() * T_odom_cam;
  before_ = T_odom_cam;
  const double metres = step.translation().norm(), rad = step.so3().Log().norm();
  const OdometryFailures failures = reported ? Reported(*reported) : Judge(metres, rad);
  // Whether the step is as long as it seems, and turns as much.
  const bool is_long = failures.lost == 0 && failures.translation_m2 < 0.5 * metres * metres;
  const bool is_turn = failures.lost == 0 && failures.rotation_rad2 < 0.5 * rad * rad;
  last_.push_back({is_long ? metres : 0, is_turn ? rad : 0});
  if (last_.size() > kSteps) last_.pop_front();
  return failures;
}

}  // namespace sslcd
