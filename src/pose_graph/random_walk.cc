// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/random_walk.h"

#include <cmath>
#include <tuple>
#include <utility>

namespace sslcd {
namespace {

constexpr double kFreedom = 4;  // of the Student-t distribution; set by hand
constexpr int kRounds = 3;      // of weights, for each rate
// Rates that are tried, in units of the measurements per root of path; set by hand.
constexpr double kLeastRate = 1e-4, kMostRate = 1, kRateStep = 1.25;
// Variance of a step of infinite length, in squared units of the measurements: larger than what is
// measured, and not too large for the arithmetic.
constexpr double kAnywhere = 1e8;

double VarianceOf(double length, double rate) {
  return std::isinf(length) ? kAnywhere : rate * rate * length;
}

}  // namespace

RandomWalk::RandomWalk(const std::vector<double>& lengths, std::vector<WalkDifference> measured)
    : lengths_(Eigen::Map<const Eigen::VectorXd>(lengths.data(),
                                                 static_cast<Eigen::Index>(lengths.size()))),
      measured_(std::move(measured)),
      mean_(Eigen::VectorXd::Zero(lengths_.size() + 1)) {
  if (measured_.empty()) return;
  double least = 0;
  Eigen::VectorXd best_weights;
  UpdateWeights();
  for (double rate = kLeastRate; rate <= kMostRate; rate *= kRateStep) {
    for (int round = 0; round < kRounds; ++round) {
      Solve(rate);
      UpdateWeights();
    }
    const double cost = Cost(rate);
    if (rate_ > 0 && cost >= least) continue;
    least = cost;
    rate_ = rate;
    best_weights = weights_;
  }
  weights_ = best_weights;
  Solve(rate_);
}

// By the errors of the current mean.
void RandomWalk::UpdateWeights() {
  weights_.resize(static_cast<Eigen::Index>(measured_.size()));
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    const WalkDifference& each = measured_[i];
    const double error = (mean_[each.to] - mean_[each.from] - each.value) / each.sigma;
    weights_[static_cast<Eigen::Index>(i)] = (kFreedom + 1) / (kFreedom + error * error);
  }
}

// Solves for the mean with this rate and the current weights.
void RandomWalk::Solve(double rate) {
  const Eigen::Index count = lengths_.size();
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  const auto add = [&](Eigen::Index from, Eigen::Index to, double information, double value) {
    for (const auto& [a, b, sign] : {std::tuple(from, from, 1), std::tuple(to, to, 1),
                                     std::tuple(from, to, -1), std::tuple(to, from, -1)})
      if (a > 0 && b > 0) entries.emplace_back(a - 1, b - 1, sign * information);
    if (to > 0) right[to - 1] += information * value;
    if (from > 0) right[from - 1] -= information * value;
  };
  for (Eigen::Index k = 0; k < count; ++k) add(k, k + 1, 1 / VarianceOf(lengths_[k], rate), 0);
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    const WalkDifference& each = measured_[i];
    add(each.from, each.to, weights_[static_cast<Eigen::Index>(i)] / (each.sigma * each.sigma),
        each.value);
  }
  Eigen::SparseMatrix<double> information(count, count);
  information.setFromTriplets(entries.begin(), entries.end());
  information_.compute(information);
  mean_.tail(count) = information_.solve(right);
}

// -2 log of the marginal likelihood of the measurements, up to a constant.
double RandomWalk::Cost(double rate) const {
  const auto steps = static_cast<double>(lengths_.array().isFinite().count());
  double sum = information_.vectorD().array().log().sum() + 2 * std::log(rate) * steps;
  for (Eigen::Index k = 0; k < lengths_.size(); ++k)
    sum += std::pow(mean_[k + 1] - mean_[k], 2) / VarianceOf(lengths_[k], rate);
  for (const WalkDifference& each : measured_) {
    const double error = (mean_[each.to] - mean_[each.from] - each.value) / each.sigma;
    sum += (kFreedom + 1) * std::log1p(error * error / kFreedom);
  }
  return sum;
}

double RandomWalk::VarianceAlong(const Eigen::VectorXd& direction) const {
  if (measured_.empty()) return 0;
  const Eigen::VectorXd d = direction.tail(lengths_.size());
  return d.dot(information_.solve(d));
}

}  // namespace sslcd
