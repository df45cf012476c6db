// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/frame_store.h"
#include "pipeline/gravity_aligner.h"
#include "sslcd/core/pose.h"
#include "sslcd/refine/options.h"

namespace sslcd {

/// Odometry without its systematic errors: its heading, which turns with the path (a bias of the
/// gyro, an offset of the steering angle, a camera that is not calibrated well), is turned back,
/// and its vertical is aligned (GravityAligner). FrameRecord::T_odom_cam has the result.
class CorrectedOdometry {
 public:
  CorrectedOdometry(const GravityFrame& gravity, const LevelOptions& options)
      : gravity_(gravity), options_(options), aligner_(gravity, options) {}

  /// The next frame begins a sequence: its odometry is upright again.
  void StartSequence();

  /// Corrects the pose of the next frame.
  Pose Correct(const Pose& T_input_cam);

  /// Corrects all frames again, and the next ones, by `turn`: what turns the heading back,
  /// counterclockwise [rad per metre of odometry's path].
  void SetTurn(double turn, FrameStore& frames);
  double turn() const { return turn_; }

 private:
  Pose TurnBack(const Pose& T_input_cam);

  GravityFrame gravity_;
  LevelOptions options_;
  GravityAligner aligner_;
  double turn_ = 0;
  std::optional<Pose> raw_;  // the last input pose
  Pose turned_;              // the last one, turned back
};

}  // namespace sslcd
