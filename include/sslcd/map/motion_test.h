// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sslcd/core/fields.h"
#include "sslcd/core/pose.h"

namespace sslcd {

/// Parked or driving? Two models explain an object's horizontal positions in the world: one that
/// stands still and one that drives at nearly constant velocity. The log Bayes factor between them
/// is the stationarity test: the driving model can follow anything, and pays for that with a wide
/// prediction whenever standing still would have done. A detector's bias turns with the viewing
/// ray, so a parked object seems to creep as the camera drives by. Driving therefore also takes a
/// real distance at a real speed.
struct MotionTestOptions {
  double decide_at = 6.;       ///< log Bayes factor at which an object is called driving [nats]
  double min_travel_m = 2.;    ///< an object that has moved less is not called driving
  double min_speed_mps = 0.7;  ///< an object that is slower is not called driving
  double settle_s = 1.5;  ///< a driving object that has stopped for this time is a new parked one

  // No keys: properties of road users and of the models, set by hand; no search over them is
  // recorded.
  double speed_prior_mps = 8.;    ///< standard deviation of an unknown object's speed, per axis
  double acceleration_mps2 = 2.;  ///< standard deviation of a driving object's acceleration
  /// random walk of a parked object's position that camera drift causes
  double wander_m_per_sqrt_s = 0.02;
  double max_parked_speed_mps = 2.;  ///< a parked object's speed is below this, with one standard
                                     ///< deviation to spare
  /// limit of the log Bayes factor: the evidence that a change of state has to overcome [nats]
  double memory = 10.;
  double forget_after_s = 5.;  ///< the test of an object unseen for longer starts again
};
void DescribeFields(FieldVisitor& visitor, MotionTestOptions& options);

enum class Motion { kUndecided, kParked, kDriving };

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
