// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/corrected_odometry.h"

#include <algorithm>

namespace sslcd {
namespace {

// A longer step is a failure, whose length is not that of a path. Set by hand. [m]
constexpr double kLongestStep = 30;

}  // namespace

void CorrectedOdometry::StartSequence() {
  aligner_ = GravityAligner(gravity_, options_);
  raw_.reset();
}

Pose CorrectedOdometry::Correct(const Pose& T_input_cam) {
  return aligner_.Align(TurnBack(T_input_cam));
}

// Half of a step's turn comes before its translation, half of it after.
Pose CorrectedOdometry::TurnBack(const Pose& T_input_cam) {
  if (raw_) {
    const Pose step = raw_->inverse() * T_input_cam;
    const double turn = turn_ * std::min(kLongestStep, double(step.translation().norm()));
    const auto half = [&](const Pose& T) {
      return lie::SO3<double>::Exp(Vec3(0.5 * turn * (T.so3().inverse() * gravity_.up)));
    };
    const auto before = half(*raw_), after = half(T_input_cam);
    turned_ = turned_ * Pose(before * step.so3() * after, before * step.translation());
    turned_.normalise();
  } else {
    turned_ = T_input_cam;
  }
  raw_ = T_input_cam;
  return turned_;
}

void CorrectedOdometry::SetTurn(double turn, FrameStore& frames) {
  if (turn == turn_) return;
  turn_ = turn;
  for (int f = 0; f < frames.size(); ++f) {
    if (f == 0 || frames[f].sequence != frames[f - 1].sequence) StartSequence();
    frames.SetOdometry(f, Correct(frames[f].T_input_cam));
  }
}

}  // namespace sslcd
