// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "sslcd/core/detection.h"

namespace sslcd {

/// What the steps in which odometry failed, or said that it was uncertain, add to the variance that
/// its noise explains, and the number of steps in which it was lost.
struct OdometryFailures {
  double translation_m2 = 0, rotation_rad2 = 0;
  int lost = 0;

  OdometryFailures& operator+=(const OdometryFailures& other) {
    translation_m2 += other.translation_m2;
    rotation_rad2 += other.rotation_rad2;
    lost += other.lost;
    return *this;
  }
};

/// Judges the steps of an odometry one by one. Copyable.
class StepJudge {
 public:
  /// The failures in the step to this pose: as reported, or else judged. Where none is reported,
  /// odometry has failed in a step that is much longer than any of the steps before it, or turns by
  /// much more. None for the first pose.
  OdometryFailures Add(const Pose& T_odom_cam, const std::optional<StepUncertainty>& reported);

 private:
  struct Step {
    double metres = 0, rad = 0;  // 0: a failure, which is no measure for later steps
  };
  OdometryFailures Judge(double metres, double rad) const;

  std::optional<Pose> before_;
  std::deque<Step> last_;
};

}  // namespace sslcd
