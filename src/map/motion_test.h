// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sslcd/core/pose.h"
#include "sslcd/map/options.h"

namespace sslcd {

enum class Motion { kUndecided, kParked, kDriving };

/// Decides whether an object is parked or driving. Two models explain its horizontal positions in
/// the world: a parked object, and an object with nearly constant velocity. The test statistic is
/// the log Bayes factor between them: the driving model fits any motion, but its wide predictions
/// cost likelihood for a parked object. A detector's bias rotates with the viewing ray, so a parked
/// object seems to move slowly while the camera passes. Driving therefore also requires a minimum
/// distance and speed.
class MotionTest {
 public:
  using Point = Vec2;
  using Covariance = Eigen::Matrix<double, 2, 2, Eigen::DontAlign>;
  struct Prediction {
    Point position;
    Covariance covariance;
  };

  /// Adds a horizontal position [m] with its covariance [m^2] at `stamp` [s].
  void Add(const Point& position, const Covariance& covariance, double stamp,
           const MotionTestOptions& options);

  Prediction PredictParked(double stamp, const MotionTestOptions& options) const;
  Prediction PredictDriving(double stamp, const MotionTestOptions& options) const;

  Motion Verdict(const MotionTestOptions& options) const;

  /// Time since when the object is at rest, according to the driving model. [s]
  double StandingSince() const { return standing_since_; }
  double Stamp() const { return stamp_; }

  /// Forgets the motion so far.
  void Restart();

  /// Positive if driving explains the positions better. [nats]
  double log_bayes_factor() const { return log_bayes_factor_; }
  int count() const { return count_; }
  Point velocity() const { return state_.tail<2>(); }  ///< of the driving model [m/s]

  /// Moves both models, e.g. after an optimisation has moved the landmark. [m]
  void Shift(const Point& by);

 private:
  int count_ = 0;
  double stamp_ = 0, start_stamp_ = 0, standing_since_ = 0;
  double log_bayes_factor_ = 0;
  Point start_{0, 0}, parked_{0, 0};
  Covariance start_covariance_ = Covariance::Zero();
  Covariance parked_covariance_ = Covariance::Zero();
  Eigen::Matrix<double, 4, 1, Eigen::DontAlign> state_ =
      Eigen::Matrix<double, 4, 1, Eigen::DontAlign>::Zero();
  Eigen::Matrix<double, 4, 4, Eigen::DontAlign> state_covariance_ =
      Eigen::Matrix<double, 4, 4, Eigen::DontAlign>::Zero();
};

}  // namespace sslcd
