// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sslcd/core/pose.h"
#include "sslcd/map/options.h"

namespace sslcd {

enum class Motion { kUndecided, kParked, kDriving };

/// Parked or driving? Two models explain an object's horizontal positions in the world: one that
/// stands still and one that drives at nearly constant velocity. The log Bayes factor between them
/// is the stationarity test: the driving model can follow anything, and pays for that with a wide
/// prediction whenever standing still would have done. A detector's bias turns with the viewing
/// ray, so a parked object seems to creep as the camera drives by. Driving therefore also takes a
/// real distance at a real speed.
class MotionTest {
 public:
  using Point = Vec2;
  using Covariance = Eigen::Matrix<double, 2, 2, Eigen::DontAlign>;
  struct Prediction {
    Point position;
    Covariance covariance;
  };

  /// Horizontal position [m] with its covariance at `stamp` [s].
  void Add(const Point& position, const Covariance& covariance, double stamp,
           const MotionTestOptions& options);

  Prediction PredictParked(double stamp, const MotionTestOptions& options) const;
  Prediction PredictDriving(double stamp, const MotionTestOptions& options) const;

  Motion Verdict(const MotionTestOptions& options) const;

  /// Since when the object has been standing, by the driving model's own speed. [s]
  double StandingSince() const { return standing_since_; }
  double Stamp() const { return stamp_; }

  /// Forgets that it ever drove.
  void Restart();

  /// > 0: driving explains the positions better.
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
