// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "closing/loop_meter.h"
#include "closing/pass_layout.h"
#include "closing/trajectory_uncertainty.h"
#include "loop/pose_tracks.h"

namespace sslcd {

/// What odometry and the accepted loops say of a pose of the local map, before objects are
/// compared. The error of the trajectory that a pose implies follows a Student-t distribution
/// (docs/decision.md) with the covariance of TrajectoryUncertainty. Its heavy tail is for errors
/// that the noise learnt in sight does not foresee.
class OdometryPrior {
 public:
  /// `here` is the frame in the middle of the local map. Keeps references to the other arguments.
  OdometryPrior(const MapState& state, const PassMap& passes, const PassLayout& local,
                const LayoutIndex& index, const TrajectoryUncertainty& uncertainty, int here)
      : state_(state),
        passes_(passes),
        local_(local),
        index_(index),
        uncertainty_(uncertainty),
        here_(here) {}

  /// The prior of a pose with its matches. Says nothing without any, or if odometry was lost
  /// between here and there and no loop has joined the two.
  PosePrior Of(const YawShift& pose, const LayoutFit& fit) const;

  /// Log likelihood of a loop's measured height against the height of the trajectory; never
  /// positive. [nats]
  double OfHeight(const LoopMeasurement& loop) const;

  /// Orders poses by the drift since the first frame that they imply; the larger, the more
  /// probable.
  double Rank(const YawShift& pose) const;

  /// Largest rise of the world between here and an old frame that is no outlier. [m]
  double LargestRise() const;

 private:
  Eigen::Matrix4d Covariance(int from, int to) const;
  double HeightVariance(int from, int to) const;
  Eigen::Matrix<double, 3, 6> CameraMotion(int frame) const;
  Vec3 Camera() const;
  Vec3 LevelError(const YawShift& pose, const Vec3& point) const;
  double OfRise(int from, int to, double rise_m) const;

  const MapState& state_;
  const PassMap& passes_;
  const PassLayout& local_;
  const LayoutIndex& index_;
  const TrajectoryUncertainty& uncertainty_;
  int here_;
};

}  // namespace sslcd
