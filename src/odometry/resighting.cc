// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/resighting.h"

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

// Sum of the logs of Student-t densities of `size` dimensions, up to a constant.
class StudentLogs {
 public:
  explicit StudentLogs(int size) : size_(size) {}

  // Determinant of the covariance, squared Mahalanobis distance.
  void Add(double determinant, double distance2) {
    determinants_.Multiply(determinant);
    distances_.Multiply(1 + distance2 / kFreedom);
  }
  double Sum() const {
    return -0.5 * determinants_.Log() - 0.5 * (kFreedom + size_) * distances_.Log();
  }

 private:
  int size_;
  LogProduct determinants_, distances_;
};

// The horizontal part of a resighting; covariances by their elements (0, 0), (0, 1) and (1, 1).
struct Level {
  explicit Level(const Resighting& both)
      : moved(both.moved.head<2>()),
        detection(Elements(both.detection.topLeftCorner<2, 2>())),
        translation(Elements(both.translation.topLeftCorner<2, 2>())),
        rotation(Elements(both.rotation.topLeftCorner<2, 2>())),
        fixed(Elements(both.fixed)) {}
  static Eigen::Vector3d Elements(const Eigen::Matrix2d& m) { return {m(0, 0), m(0, 1), m(1, 1)}; }

  Eigen::Vector2d moved;
  Eigen::Vector3d detection, translation, rotation, fixed;
};

// Logs of the factors on the standard deviations of the detector, and of odometry's positions and
// headings together; log of the ratio of the two. Positions and headings apart would be a ridge,
// along which a pattern search is slow.
using HorizontalLogs = std::array<double, 3>;
double PositionLog(const HorizontalLogs& logs) { return logs[1] + 0.5 * logs[2]; }
double HeadingLog(const HorizontalLogs& logs) { return logs[1] - 0.5 * logs[2]; }

// The priors of the logs of all factors are standard normal, set by hand.
double HorizontalPosterior(const std::vector<Level>& all, const HorizontalLogs& logs) {
  const auto [detector, odometry, ratio] = logs;
  const double of_detector = std::exp(2 * detector), of_position = std::exp(2 * PositionLog(logs)),
               of_heading = std::exp(2 * HeadingLog(logs));
  StudentLogs likelihood(2);
  for (const Level& each : all) {
    const Eigen::Vector3d c = of_detector * each.detection + of_position * each.translation +
                              of_heading * each.rotation + each.fixed;
    const double x = each.moved.x(), y = each.moved.y(), determinant = c[0] * c[2] - c[1] * c[1];
    likelihood.Add(determinant, (c[2] * x * x - 2 * c[1] * x * y + c[0] * y * y) / determinant);
  }
  return likelihood.Sum() -
         0.5 * (detector * detector + odometry * odometry + std::pow(ratio / kRatioSigma, 2));
}

// `log_factors`: on the standard deviations of the detector and of odometry.
double VerticalPosterior(const std::vector<Resighting>& all,
                         const std::array<double, 2>& log_factors) {
  const auto [detector, odometry] = log_factors;
  const double of_detector = std::exp(2 * detector), of_odometry = std::exp(2 * odometry);
  StudentLogs likelihood(1);
  for (const Resighting& each : all) {
    const double variance =
        of_detector * each.detection(2, 2) + of_odometry * each.odometry()(2, 2);
    likelihood.Add(variance, each.moved.z() * each.moved.z() / variance);
  }
  return likelihood.Sum() - 0.5 * (detector * detector + odometry * odometry);
}

}  // namespace

OdometryFactors FactorsFromResightings(const std::vector<Resighting>& resightings,
                                       const OdometryFactors& start) {
  const std::vector<Level> level(resightings.begin(), resightings.end());
  const double position = std::log(start.horizontal), heading = std::log(start.heading);
  HorizontalLogs horizontal = MaximiseOverLogs<3>(
      [&](const HorizontalLogs& logs) { return HorizontalPosterior(level, logs); },
      {0, 0.5 * (position + heading), position - heading});
  if (horizontal[2] > 0) {
    const auto one = MaximiseOverLogs<2>(
        [&](const std::array<double, 2>& logs) {
          return HorizontalPosterior(level, {logs[0], logs[1], 0});
        },
        {horizontal[0], horizontal[1]});
    horizontal = {one[0], one[1], 0};
  }
  const auto vertical = MaximiseOverLogs<2>(
      [&](const std::array<double, 2>& log_factors) {
        return VerticalPosterior(resightings, log_factors);
      },
      {horizontal[0], std::log(start.vertical)});
  OdometryFactors factors;
  factors.horizontal = std::exp(PositionLog(horizontal));
  factors.heading = std::exp(HeadingLog(horizontal));
  factors.vertical = factors.tilt = std::exp(vertical[1]);
  return factors;
}

}  // namespace sslcd
