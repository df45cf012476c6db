// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/resighting.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "odometry/pattern_search.h"

namespace sslcd {
namespace {

constexpr double kFreedom = 4;  // of the Student-t likelihood; set by hand
// Standard deviation of the log of the ratio of the factors of position and heading; set by hand.
constexpr double kRatioSigma = 0.5;

// A sum of logs as the log of a product, which costs a fraction of it.
class LogProduct {
 public:
  void Multiply(double factor) {
    constexpr double kLeast = 1e-100, kMost = 1e100;
    product_ *= factor;
    if (product_ > kLeast && product_ < kMost) return;
    sum_ += std::log(product_);
    product_ = 1;
  }
  double Log() const { return sum_ + std::log(product_); }

 private:
  double product_ = 1, sum_ = 0;
};

// Sum of the logs of Student-t densities, up to a constant.
template <int kSize>
class StudentLogs {
 public:
  void Add(const Eigen::Matrix<double, kSize, 1>& error,
           const Eigen::Matrix<double, kSize, kSize>& covariance) {
    determinants_.Multiply(covariance.determinant());
    distances_.Multiply(1 + error.dot(covariance.inverse() * error) / kFreedom);
  }
  double Sum() const {
    return -0.5 * determinants_.Log() - 0.5 * (kFreedom + kSize) * distances_.Log();
  }

 private:
  LogProduct determinants_, distances_;
};

// The priors of the logs of all factors are standard normal, set by hand; `log_factors` are those
// of the standard deviations of the detector, of positions and of headings.
double HorizontalPosterior(const std::vector<Resighting>& all,
                           const std::array<double, 3>& log_factors) {
  const auto [detector, position, heading] = log_factors;
  const double mean = 0.5 * (position + heading), ratio = (position - heading) / kRatioSigma;
  const double of_detector = std::exp(2 * detector), of_position = std::exp(2 * position),
               of_heading = std::exp(2 * heading);
  StudentLogs<2> likelihood;
  for (const Resighting& each : all) {
    const Eigen::Matrix2d covariance = of_detector * each.detection.topLeftCorner<2, 2>() +
                                       of_position * each.translation.topLeftCorner<2, 2>() +
                                       of_heading * each.rotation.topLeftCorner<2, 2>() +
                                       each.fixed;
    likelihood.Add(each.moved.head<2>(), covariance);
  }
  return likelihood.Sum() - 0.5 * (detector * detector + mean * mean + ratio * ratio);
}

// `log_factors`: on the standard deviations of the detector and of odometry.
double VerticalPosterior(const std::vector<Resighting>& all,
                         const std::array<double, 2>& log_factors) {
  const auto [detector, odometry] = log_factors;
  const double of_detector = std::exp(2 * detector), of_odometry = std::exp(2 * odometry);
  StudentLogs<1> likelihood;
  for (const Resighting& each : all) {
    const double variance =
        of_detector * each.detection(2, 2) + of_odometry * each.odometry()(2, 2);
    likelihood.Add(each.moved.tail<1>(), Eigen::Matrix<double, 1, 1>(variance));
  }
  return likelihood.Sum() - 0.5 * (detector * detector + odometry * odometry);
}

}  // namespace

OdometryFactors FactorsFromResightings(const std::vector<Resighting>& resightings) {
  const auto apart = MaximiseOverLogs<3>([&](const std::array<double, 3>& log_factors) {
    return HorizontalPosterior(resightings, log_factors);
  });
  double position = apart[1], heading = apart[2];
  if (position > heading) {
    const auto one = MaximiseOverLogs<2>([&](const std::array<double, 2>& log_factors) {
      return HorizontalPosterior(resightings, {log_factors[0], log_factors[1], log_factors[1]});
    });
    position = heading = one[1];
  }
  const auto vertical = MaximiseOverLogs<2>([&](const std::array<double, 2>& log_factors) {
    return VerticalPosterior(resightings, log_factors);
  });
  OdometryFactors factors;
  factors.horizontal = std::exp(position);
  factors.heading = std::exp(heading);
  factors.vertical = factors.tilt = std::exp(vertical[1]);
  return factors;
}

}  // namespace sslcd
