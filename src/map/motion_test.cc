// SPDX-License-Identifier: BSD-3-Clause
#include "map/motion_test.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

using Matrix2 = Eigen::Matrix2d;
using Matrix4 = Eigen::Matrix4d;

// Constant velocity over dt with white noise of the acceleration.
Matrix4 Transition(double dt) {
  Matrix4 F = Matrix4::Identity();
  F.topRightCorner<2, 2>() = dt * Matrix2::Identity();
  return F;
}

Matrix4 ProcessNoise(double dt, double acceleration) {
  const double q = acceleration * acceleration;
  Matrix4 Q = Matrix4::Zero();
  Q.topLeftCorner<2, 2>() = 0.25 * dt * dt * dt * dt * q * Matrix2::Identity();
  Q.topRightCorner<2, 2>() = 0.5 * dt * dt * dt * q * Matrix2::Identity();
  Q.bottomLeftCorner<2, 2>() = Q.topRightCorner<2, 2>();
  Q.bottomRightCorner<2, 2>() = dt * dt * q * Matrix2::Identity();
  return Q;
}

// Limit of a squared Mahalanobis distance (four sigmas), so that one outlier decides nothing. Set
// by hand.
constexpr double kMaxDistance2 = 16.;

// Gaussian log density up to a constant.
double LogLikelihood(const Eigen::Vector2d& innovation, const Matrix2& covariance) {
  const double distance = innovation.dot(covariance.inverse() * innovation);
  return -0.5 * (std::min(distance, kMaxDistance2) + std::log(covariance.determinant()));
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, MotionTestOptions& options) {
  visitor.Real("decide_at", options.decide_at, 0.1, 100,
               "log Bayes factor at which an object is called driving [nats]");
  visitor.Real("min_travel_m", options.min_travel_m, 0, 1000,
               "an object that has moved less is not called driving");
  visitor.Real("min_speed_mps", options.min_speed_mps, 0, 100,
               "an object that is slower is not called driving");
  visitor.Real("settle_s", options.settle_s, 0, 1e6,
               "a driving object that has stopped for this time is a new parked one");
}

void MotionTest::Add(const Point& position, const Covariance& covariance, double stamp,
                     const MotionTestOptions& options) {
  if (count_ > 0 && stamp - stamp_ <= options.forget_after_s) {
    const Prediction parked = PredictParked(stamp, options);
    const Prediction driving = PredictDriving(stamp, options);
    const Matrix2 parked_innovation = parked.covariance + covariance;
    const Matrix2 driving_innovation = driving.covariance + covariance;
    const Eigen::Vector2d parked_error = position - parked.position,
                          driving_error = position - driving.position;
    log_bayes_factor_ += LogLikelihood(driving_error, driving_innovation) -
                         LogLikelihood(parked_error, parked_innovation);
    log_bayes_factor_ = std::clamp(log_bayes_factor_, -options.memory, options.memory);

    const Matrix2 parked_gain = parked.covariance * parked_innovation.inverse();
    parked_ = parked.position + parked_gain * parked_error;
    parked_covariance_ = (Matrix2::Identity() - parked_gain) * parked.covariance;

    const double dt = stamp - stamp_;
    const Matrix4 predicted = Transition(dt) * state_covariance_ * Transition(dt).transpose() +
                              ProcessNoise(dt, options.acceleration_mps2);
    const Eigen::Matrix<double, 4, 2> gain = predicted.leftCols<2>() * driving_innovation.inverse();
    state_ = Transition(dt) * state_ + gain * driving_error;
    state_covariance_ = predicted - gain * predicted.topRows<2>();
  } else {
    start_ = parked_ = position;
    start_covariance_ = parked_covariance_ = covariance;
    start_stamp_ = stamp;
    state_ << position, 0, 0;
    state_covariance_.setZero();
    state_covariance_.topLeftCorner<2, 2>() = covariance;
    state_covariance_.bottomRightCorner<2, 2>() =
        options.speed_prior_mps * options.speed_prior_mps * Matrix2::Identity();
    standing_since_ = stamp;
  }
  stamp_ = stamp;
  if (state_.tail<2>().norm() > options.min_speed_mps) standing_since_ = stamp;
  // A trip starts at the last position at rest.
  if (stamp_ - standing_since_ >= options.settle_s) {
    start_ = parked_;
    start_covariance_ = parked_covariance_;
    start_stamp_ = stamp_;
  }
  ++count_;
}

Motion MotionTest::Verdict(const MotionTestOptions& options) const {
  const Eigen::Vector2d travel = state_.head<2>() - start_;
  const double distance = travel.norm(), elapsed = stamp_ - start_stamp_;
  const Eigen::Vector2d direction = travel.normalized();  // no travel: zero, and not far enough
  const Matrix2 uncertainty = start_covariance_ + Matrix2(state_covariance_.topLeftCorner<2, 2>());
  const double sigma = std::sqrt(direction.dot(uncertainty * direction));
  const bool far_enough = distance > std::max(options.min_travel_m, 2 * sigma);
  const bool fast_enough = distance > options.min_speed_mps * elapsed;
  if (log_bayes_factor_ >= options.decide_at && far_enough && fast_enough) return Motion::kDriving;

  const Matrix2 speed_covariance = state_covariance_.bottomRightCorner<2, 2>();
  const double speed = state_.tail<2>().norm() + std::sqrt(0.5 * speed_covariance.trace());
  if (speed < options.max_parked_speed_mps && (log_bayes_factor_ <= 0 || !fast_enough))
    return Motion::kParked;
  return Motion::kUndecided;
}

MotionTest::Prediction MotionTest::PredictParked(double stamp,
                                                 const MotionTestOptions& options) const {
  const double dt = std::max(0., stamp - stamp_);
  const double wander = options.wander_m_per_sqrt_s * options.wander_m_per_sqrt_s *
                        std::min(dt, options.forget_after_s);
  return {parked_, parked_covariance_ + wander * Matrix2::Identity()};
}

MotionTest::Prediction MotionTest::PredictDriving(double stamp,
                                                  const MotionTestOptions& options) const {
  const double dt = std::clamp(stamp - stamp_, 0., options.forget_after_s);
  const Matrix4 covariance = Transition(dt) * state_covariance_ * Transition(dt).transpose() +
                             ProcessNoise(dt, options.acceleration_mps2);
  return {state_.head<2>() + dt * state_.tail<2>(), covariance.topLeftCorner<2, 2>()};
}

void MotionTest::Restart() {
  start_ = parked_ = state_.head<2>();
  start_covariance_ = parked_covariance_ = state_covariance_.topLeftCorner<2, 2>();
  start_stamp_ = stamp_;
  log_bayes_factor_ = 0;
}

void MotionTest::Shift(const Point& by) {
  start_ += by;
  parked_ += by;
  state_.head<2>() += by;
}

}  // namespace sslcd
