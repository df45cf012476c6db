// SPDX-License-Identifier: BSD-3-Clause
#include "loop/drift_problem.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "core/median.h"

namespace sslcd::drift {
namespace {

double Loss(double mean_square, double scale) {
  return scale > 0 ? scale * scale * std::log1p(mean_square / (scale * scale)) : mean_square;
}

// Stops, with less than the cost, once it is `enough`.
double Cost(const Problem& problem, const State& state, double enough) {
  double cost = 0;
  for (const Match& match : problem.matches) {
    if (cost >= enough) break;
    const Vec3 e = PositionError(match, problem, state).cwiseQuotient(match.sigma);
    cost += 3 * Loss(e.squaredNorm() / 3, problem.loss_scale);
    if (match.has_yaw())
      cost += Loss(std::pow(YawError(match, state) / match.sigma_yaw, 2), problem.loss_scale);
  }
  return cost;
}

/// The shift for a yaw: the median over the matches, which is robust against a few wrong ones.
State WithYaw(double yaw, const Problem& problem) {
  State state{Rotation::RotZ(yaw), Vec3(Vec3::Zero())};
  std::vector<double> shifts[3];
  for (const Match& match : problem.matches) {
    const Vec3 shift = match.global - state.R * Vec3(match.local - problem.centre);
    for (int axis = 0; axis < 3; ++axis) shifts[axis].push_back(shift[axis]);
  }
  for (int axis = 0; axis < 3; ++axis) state.t[axis] = Median(std::move(shifts[axis]));
  return state;
}

Vec3 WeightedMean(const std::vector<Match>& matches, Vec3 Match::*point) {
  Vec3 mean = Vec3::Zero();
  double weights = 0;
  for (const Match& match : matches) {
    mean += match.weight() * match.*point;
    weights += match.weight();
  }
  return mean / weights;
}

/// Weighted Procrustes about the vertical: the argument of the sum is the yaw, and its modulus is
/// the concentration of the corresponding von Mises distribution, about 1/sigma^2.
std::complex<double> Procrustes(const Problem& problem) {
  const Vec3 middle = WeightedMean(problem.matches, &Match::global);
  std::complex<double> sum = 0;
  for (const Match& match : problem.matches) {
    const Vec3 local = match.local - problem.centre, global = match.global - middle;
    sum += match.weight() * std::conj(std::complex<double>(local.x(), local.y())) *
           std::complex<double>(global.x(), global.y());
  }
  return sum;
}

}  // namespace

std::string Check(const std::vector<DriftPair>& pairs) {
  if (pairs.empty()) return "no matched objects";
  for (const DriftPair& pair : pairs) {
    for (const Pose* T : {&pair.T_world_local, &pair.T_world_global})
      if (!std::all_of(T->data(), T->data() + 7, [](double x) { return std::isfinite(x); }))
        return "a matched object's pose is not finite";
    for (const double sigma : {pair.sigma_horizontal_m, pair.sigma_vertical_m, pair.sigma_yaw_rad})
      if (!(sigma > 0 && std::isfinite(sigma))) return "a matched object's sigma is not positive";
  }
  return "";
}

Problem MakeProblem(const std::vector<DriftPair>& pairs, const GravityFrame& gravity,
                    double loss_scale) {
  const Mat3 to_gravity = gravity.Basis().transpose();
  Problem problem{{}, Vec3(Vec3::Zero()), loss_scale};
  for (const DriftPair& pair : pairs) {
    const double yaw_global = gravity.YawOf(pair.T_world_global.so3());
    problem.matches.push_back(
        {to_gravity * pair.T_world_local.translation(),
         to_gravity * pair.T_world_global.translation(), gravity.YawOf(pair.T_world_local.so3()),
         yaw_global, YawPeriod(pair.symmetry),
         Vec3(pair.sigma_horizontal_m, pair.sigma_horizontal_m, pair.sigma_vertical_m),
         pair.sigma_yaw_rad, Rotation::RotZ(-yaw_global).matrix()});
  }
  problem.centre = WeightedMean(problem.matches, &Match::local);
  return problem;
}

Vec3 PositionError(const Match& match, const Problem& problem, const State& state) {
  return match.to_global * (state.R * Vec3(match.local - problem.centre) + state.t - match.global);
}

Vec3 Heading(const Match& match, const State& state) {
  return state.R * Vec3(std::cos(match.yaw_local), std::sin(match.yaw_local), 0);
}

double YawError(const Match& match, const State& state) {
  const Vec3 heading = Heading(match, state);
  return WrapAngle(std::atan2(heading.y(), heading.x()) - match.yaw_global, match.period);
}

std::optional<Start> FindStart(const Problem& problem, double max_yaw_sigma_rad,
                               std::string& reason) {
  std::vector<double> yaws;
  const std::complex<double> positions = Procrustes(problem);
  const bool fixed_by_positions = std::abs(positions) * max_yaw_sigma_rad * max_yaw_sigma_rad >= 1;
  if (fixed_by_positions) yaws.push_back(std::arg(positions));
  bool any_heading = false, fixed_by_headings = false;
  for (const Match& match : problem.matches) {
    if (!match.has_yaw()) continue;
    any_heading = true;
    fixed_by_headings |= match.period > M_PI + 1e-9;
    for (double turn = 0; turn < 2 * M_PI - 1e-9; turn += match.period)
      yaws.push_back(match.yaw_global - match.yaw_local + turn);
  }
  if (!fixed_by_positions && !fixed_by_headings) {
    reason =
        any_heading
            ? "the yaw is open by half a turn: objects on one spot, whose front and back are alike"
            : "nothing fixes the yaw: objects on one spot, without a heading";
    return std::nullopt;
  }
  State best;
  double lowest = std::numeric_limits<double>::infinity();
  for (const double yaw : yaws) {
    const State state = WithYaw(yaw, problem);
    const double cost = Cost(problem, state, lowest);
    if (cost < lowest) {
      lowest = cost;
      best = state;
    }
  }
  return Start{best, fixed_by_positions};
}

}  // namespace sslcd::drift
