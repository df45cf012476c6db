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

// Log of the Student-t density, up to a constant.
template <int kSize>
double LogStudent(const Eigen::Matrix<double, kSize, 1>& error,
                  const Eigen::Matrix<double, kSize, kSize>& covariance) {
  return -0.5 * std::log(covariance.determinant()) -
         0.5 * (kFreedom + kSize) * std::log1p(error.dot(covariance.inverse() * error) / kFreedom);
}

// The priors of the logs of all factors are standard normal, set by hand; `log_factors` are those
// of the standard deviations of the detector, of positions and of headings.
double HorizontalPosterior(const std::vector<Resighting>& all,
                           const std::array<double, 3>& log_factors) {
  const auto [detector, position, heading] = log_factors;
  const double mean = 0.5 * (position + heading), ratio = (position - heading) / kRatioSigma;
  const double of_detector = std::exp(2 * detector), of_position = std::exp(2 * position),
               of_heading = std::exp(2 * heading);
  double sum = -0.5 * (detector * detector + mean * mean + ratio * ratio);
  for (const Resighting& each : all) {
    const Eigen::Matrix2d covariance = of_detector * each.detection.topLeftCorner<2, 2>() +
                                       of_position * each.translation.topLeftCorner<2, 2>() +
                                       of_heading * each.rotation.topLeftCorner<2, 2>() +
                                       each.fixed;
    sum += LogStudent<2>(each.moved.head<2>(), covariance);
  }
  return sum;
}

// `log_factors`: on the standard deviations of the detector and of odometry.
double VerticalPosterior(const std::vector<Resighting>& all,
                         const std::array<double, 2>& log_factors) {
  const auto [detector, odometry] = log_factors;
  const double of_detector = std::exp(2 * detector), of_odometry = std::exp(2 * odometry);
  double sum = -0.5 * (detector * detector + odometry * odometry);
  for (const Resighting& each : all) {
    const double variance =
        of_detector * each.detection(2, 2) + of_odometry * each.odometry()(2, 2);
    sum += LogStudent<1>(each.moved.tail<1>(), Eigen::Matrix<double, 1, 1>(variance));
  }
  return sum;
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
