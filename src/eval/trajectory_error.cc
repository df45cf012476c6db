// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/eval/trajectory_error.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr const char* kAlignmentNames[] = {"none", "4dof", "se3", "sim3"};

bool IsFinite(const Pose& T) {
  return T.translation().allFinite() && T.unit_quaternion().coeffs().allFinite();
}

void Check(const std::vector<Pose>& est, const std::vector<Pose>& ref) {
  if (est.size() != ref.size()) {
    throw Error(ErrorKind::kBadInput,
                "the estimate has " + std::to_string(est.size()) + " poses and the reference " +
                    std::to_string(ref.size()) +
                    ": pair them first, with MatchByStamp() or by cutting the longer one");
  }
  if (est.empty())
    throw Error(ErrorKind::kBadInput, "no poses to compare: the trajectories are empty");
  for (std::size_t i = 0; i < est.size(); ++i) {
    if (IsFinite(est[i]) && IsFinite(ref[i])) continue;
    throw Error(ErrorKind::kBadInput,
                std::string("pose ") + std::to_string(i) + " of the " +
                    (IsFinite(est[i]) ? "reference" : "estimate") +
                    " is not finite: leave such poses out of both trajectories");
  }
}

/// Positions relative to their mean.
struct Centred {
  Vec3 mean;
  Eigen::Matrix3Xd offsets;

  explicit Centred(const std::vector<Pose>& poses) : offsets(3, poses.size()) {
    for (std::size_t i = 0; i < poses.size(); ++i) offsets.col(i) = poses[i].translation();
    mean = offsets.rowwise().mean();
    offsets.colwise() -= mean;
    // Rounding of the mean must not give equal positions an extent.
    if (offsets.colwise().norm().maxCoeff() <= 1e-12 * (1 + mean.norm())) offsets.setZero();
  }
};

/// The number of values, sorted by decreasing size, that differ from zero.
int Rank(const Vec3& values) {
  return static_cast<int>((values.array() > 1e-12 * std::max(values[0], 1e-12)).count());
}

struct RotationAndScale {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  double scale = 1;
  bool unique = true;
};

/// Umeyama's eq. 38-43.
RotationAndScale AlignUmeyama(const Centred& est, const Centred& ref, bool with_scale) {
  const Eigen::Matrix3d covariance = ref.offsets * est.offsets.transpose();  // eq. 38, without 1/n
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs(1, 1, 1);  // S, eq. 43: no reflections
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs[2] = -1;

  RotationAndScale result;
  result.R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();  // eq. 40
  result.unique = Rank(svd.singularValues()) >= 2;
  const double variance = est.offsets.squaredNorm();
  // eq. 42
  if (with_scale && variance > 0) result.scale = svd.singularValues().dot(signs) / variance;
  return result;
}

/// The planar case of the same problem: the angle of the sum of the conjugate products.
RotationAndScale AlignYaw(const Centred& est, const Centred& ref, const Vec3& up) {
  if (!up.allFinite() || up.norm() == 0) {
    throw Error(ErrorKind::kUsage,
                "the 4-DoF alignment needs an up axis that is finite and not zero");
  }
  const GravityFrame gravity = GravityFrame::FromUp(up);
  const Eigen::Matrix3Xd a = gravity.Basis().transpose() * est.offsets;
  const Eigen::Matrix3Xd b = gravity.Basis().transpose() * ref.offsets;
  const double cosine = a.topRows<2>().cwiseProduct(b.topRows<2>()).sum();
  const double sine = a.row(0).dot(b.row(1)) - a.row(1).dot(b.row(0));

  RotationAndScale result;
  result.unique = std::hypot(cosine, sine) > 1e-24;
  if (result.unique)
    result.R = lie::SO3<double>::Exp(gravity.up * std::atan2(sine, cosine)).matrix();
  return result;
}

std::pair<Similarity, bool> AlignChecked(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                                         Alignment alignment, const Vec3& up) {
  if (alignment == Alignment::kNone) return {Similarity{}, true};
  const Centred p(est), q(ref);
  const RotationAndScale best = alignment == Alignment::k4Dof
                                    ? AlignYaw(p, q, up)
                                    : AlignUmeyama(p, q, alignment == Alignment::kSim3);
  const Vec3 t = q.mean - best.scale * (best.R * p.mean);  // eq. 41
  return {Similarity{best.scale, Pose(lie::SO3<double>::FromMatrix(best.R), t)}, best.unique};
}

using IndexPairs = std::vector<std::pair<int, int>>;

/// Chained pairs: each pair starts where the last one ended, and ends after `delta`.
IndexPairs ConsecutivePairs(const std::vector<double>& steps, double delta) {
  IndexPairs pairs;
  int begin = 0;
  double covered = 0;
  for (int i = 1; i < static_cast<int>(steps.size()); ++i) {
    covered += steps[i];
    if (covered < delta) continue;
    pairs.emplace_back(begin, i);
    begin = i;
    covered = 0;
  }
  return pairs;
}

/// Pairs every pose with the later pose whose distance is nearest to `delta`, if within
/// `tolerance`.
IndexPairs AllPairs(const std::vector<double>& steps, double delta, double tolerance) {
  std::vector<double> distance(steps.size());
  std::partial_sum(steps.begin(), steps.end(), distance.begin());
  IndexPairs pairs;
  const int n = static_cast<int>(steps.size());
  for (int i = 0; i + 1 < n; ++i) {
    const auto off = [&](double d) { return std::abs(d - distance[i] - delta); };
    const auto best = std::min_element(distance.begin() + i + 1, distance.end(),
                                       [&](double a, double b) { return off(a) < off(b); });
    if (off(*best) <= tolerance) pairs.emplace_back(i, static_cast<int>(best - distance.begin()));
  }
  return pairs;
}

IndexPairs FindPairs(const std::vector<Pose>& est, const RpeOptions& options) {
  const bool frames = options.unit == DeltaUnit::kFrames;
  if (!(options.delta > 0) || !std::isfinite(options.delta) ||
      (frames && std::floor(options.delta) != options.delta)) {
    throw Error(ErrorKind::kUsage, "the relative pose error's delta is " +
                                       std::to_string(options.delta) + ": give a positive " +
                                       (frames ? "whole number of frames" : "length in metres"));
  }
  // In frames every step counts 1, so whole numbers are reached exactly.
  std::vector<double> steps(est.size(), frames ? 1. : 0.);
  for (std::size_t i = 1; !frames && i < est.size(); ++i) {
    steps[i] = (est[i].translation() - est[i - 1].translation()).norm();
  }
  if (options.all_pairs) return AllPairs(steps, options.delta, frames ? 0. : 0.1 * options.delta);
  return ConsecutivePairs(steps, options.delta);
}

void CheckStamps(const Trajectory& trajectory, const char* name) {
  const std::vector<double>& stamps = trajectory.stamps;
  if (stamps.size() != trajectory.poses.size()) {
    throw Error(ErrorKind::kBadInput, std::string("the ") + name + " has " +
                                          std::to_string(stamps.size()) + " stamps and " +
                                          std::to_string(trajectory.poses.size()) + " poses");
  }
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if (std::isfinite(stamps[i]) && (i == 0 || stamps[i] >= stamps[i - 1])) continue;
    throw Error(ErrorKind::kBadInput,
                std::string("stamp ") + std::to_string(i) + " of the " + name +
                    " is not finite or decreases: sort the trajectory by time");
  }
}

}  // namespace

const char* ToString(Alignment alignment) { return kAlignmentNames[static_cast<int>(alignment)]; }

Alignment ParseAlignment(const std::string& text) {
  for (int i = 0; i < 4; ++i) {
    if (text == kAlignmentNames[i]) return static_cast<Alignment>(i);
  }
  throw Error(ErrorKind::kUsage, "unknown alignment '" + text + "': use none, 4dof, se3 or sim3");
}

ErrorStats Summarise(std::vector<double> errors) {
  ErrorStats stats;
  if (errors.empty()) return stats;
  const double n = static_cast<double>(errors.size());
  double sum = 0, squares = 0, variance = 0;
  for (const double e : errors) {
    sum += e;
    squares += e * e;
  }
  stats.mean = sum / n;
  for (const double e : errors) variance += (e - stats.mean) * (e - stats.mean);
  std::sort(errors.begin(), errors.end());
  const std::size_t middle = errors.size() / 2;
  stats.median = errors.size() % 2 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  stats.rmse = std::sqrt(squares / n);
  stats.std = std::sqrt(variance / n);
  stats.max = errors.back();
  stats.count = static_cast<int>(errors.size());
  return stats;
}

MatchedPoses MatchByStamp(const Trajectory& est, const Trajectory& ref, double max_difference_s) {
  CheckStamps(est, "estimate");
  CheckStamps(ref, "reference");
  const bool est_is_short = est.size() <= ref.size();
  const std::vector<double>& few = est_is_short ? est.stamps : ref.stamps;
  const std::vector<double>& many = est_is_short ? ref.stamps : est.stamps;

  MatchedPoses matched;
  for (std::size_t i = 0; i < few.size(); ++i) {
    const std::size_t after = std::upper_bound(many.begin(), many.end(), few[i]) - many.begin();
    const double infinity = std::numeric_limits<double>::infinity();
    const double gap_after = after < many.size() ? many[after] - few[i] : infinity;
    const double gap_before = after > 0 ? few[i] - many[after - 1] : infinity;
    if (std::min(gap_after, gap_before) > max_difference_s) continue;
    const std::size_t j = gap_after < gap_before ? after : after - 1;
    matched.est.push_back(est.poses[est_is_short ? i : j]);
    matched.ref.push_back(ref.poses[est_is_short ? j : i]);
  }
  if (matched.est.empty()) {
    const auto span = [](const std::vector<double>& s) {
      return s.empty() ? std::string("empty")
                       : std::to_string(s.front()) + " to " + std::to_string(s.back()) + " s";
    };
    throw Error(ErrorKind::kNoSolution, "no pose of the estimate (" + span(est.stamps) +
                                            ") is within " + std::to_string(max_difference_s) +
                                            " s of one of the reference (" + span(ref.stamps) +
                                            "): check that both use the same clock");
  }
  return matched;
}

Similarity Align(const std::vector<Pose>& est, const std::vector<Pose>& ref, Alignment alignment,
                 const Vec3& up) {
  Check(est, ref);
  return AlignChecked(est, ref, alignment, up).first;
}

AteResult ComputeAte(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                     Alignment alignment, const Vec3& up) {
  Check(est, ref);
  AteResult result;
  result.alignment = alignment;
  std::tie(result.S_ref_est, result.unique) = AlignChecked(est, ref, alignment, up);
  for (std::size_t i = 0; i < est.size(); ++i) {
    result.errors.push_back(
        (result.S_ref_est * est[i].translation() - ref[i].translation()).norm());
  }
  result.error = Summarise(result.errors);
  return result;
}

RpeResult ComputeRpe(const std::vector<Pose>& est, const std::vector<Pose>& ref,
                     const RpeOptions& options) {
  Check(est, ref);
  std::vector<double> translation, rotation;
  for (const auto& [i, j] : FindPairs(est, options)) {
    const Pose error = (ref[i].inverse() * ref[j]).inverse() * (est[i].inverse() * est[j]);
    translation.push_back(error.translation().norm());
    rotation.push_back(error.so3().Log().norm());
  }
  return {Summarise(std::move(translation)), Summarise(std::move(rotation))};
}

}  // namespace sslcd
