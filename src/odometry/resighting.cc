// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/resighting.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "odometry/pattern_search.h"

namespace sslcd {
namespace {

constexpr double kFreedom = 4;  // of the Student-t likelihood; set by hand

// Log likelihood of the coordinates `first` to first + kSize of all resightings, up to a constant,
// with the prior. `log_factors`: on the standard deviations of the detector and of odometry.
template <int kSize>
double LogPosterior(const std::vector<Resighting>& all, int first,
                    const std::array<double, 2>& log_factors) {
  const double detection = std::exp(2 * log_factors[0]), odometry = std::exp(2 * log_factors[1]);
  // The logs of both factors have a standard normal distribution a priori; set by hand.
  double sum = -0.5 * (log_factors[0] * log_factors[0] + log_factors[1] * log_factors[1]);
  for (const Resighting& each : all) {
    Eigen::Matrix<double, kSize, kSize> covariance =
        detection * each.detection.block<kSize, kSize>(first, first) +
        odometry * each.odometry.block<kSize, kSize>(first, first);
    if constexpr (kSize == 2) covariance += each.fixed;
    const Eigen::Matrix<double, kSize, 1> moved = each.moved.segment<kSize>(first);
    sum -= 0.5 * std::log(covariance.determinant());
    sum -=
        0.5 * (kFreedom + kSize) * std::log1p(moved.dot(covariance.inverse() * moved) / kFreedom);
  }
  return sum;
}

// The factor on odometry that maximises the posterior.
template <int kSize>
double OdometryFactor(const std::vector<Resighting>& all, int first) {
  return std::exp(MaximiseOverLogs([&](const std::array<double, 2>& log_factors) {
    return LogPosterior<kSize>(all, first, log_factors);
  })[1]);
}

}  // namespace

OdometryFactors FactorsFromResightings(const std::vector<Resighting>& resightings) {
  OdometryFactors factors;
  factors.horizontal = factors.heading = OdometryFactor<2>(resightings, 0);
  factors.vertical = factors.tilt = OdometryFactor<1>(resightings, 2);
  return factors;
}

}  // namespace sslcd
