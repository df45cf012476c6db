// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/refinement_plan.h"

#include <algorithm>
#include <string>

#include "sslcd/core/error.h"

namespace sslcd {

RefinementPlan::RefinementPlan(double every_m) : every_m_(every_m) {
  if (!(every_m >= 0))
    throw Error(ErrorKind::kBadConfig, "refine_every_m is " + std::to_string(every_m) +
                                           ": give a path in metres, or 0 for none");
}

bool RefinementPlan::Add(const Frame& frame) {
  constexpr double kShare = 0.05;
  const double step_m =
      before_ ? (frame.T_odom_cam.translation() - before_->translation()).norm() : 0;
  before_ = frame.T_odom_cam;
  path_m_ += std::min(step_m, every_m_);  // a jump is no path
  if (every_m_ == 0 || path_m_ - last_m_ < std::max(every_m_, kShare * last_m_)) return false;
  last_m_ = path_m_;
  return true;
}

}  // namespace sslcd
