// SPDX-License-Identifier: BSD-3-Clause
#include "check/ground_truth.h"

#include <algorithm>
#include <cmath>

#include "check/ground_truth_axes.h"
#include "core/median.h"

namespace sslcd::check {
namespace {

constexpr std::size_t kLeastDistances = 8;
constexpr int kWindows[] = {100, 30, 12};  // of which the drive is made
constexpr double kLeastDistance = 0.3;     // of the median one
constexpr double kInverseRatio = 0.3, kInverseLeast = 0.04, kOther = 0.2;
constexpr double kUnits = 30, kMillis = 300;  // ratios

/// The pose of each frame, from the nearest stamp.
std::vector<std::pair<Pose, Pose>> Matched(const Sequence& sequence) {
  std::vector<std::pair<Pose, Pose>> pairs;  // odometry, ground truth
  const Trajectory& truth = *sequence.groundtruth;
  const double tolerance =
      sequence.frames() < 2
          ? 0.1
          : 0.6 * (sequence.stamps.back() - sequence.stamps.front()) / (sequence.frames() - 1);
  for (std::size_t i = 0; i < sequence.poses.size(); ++i) {
    const double stamp = sequence.stamps[i];
    auto at = std::lower_bound(truth.stamps.begin(), truth.stamps.end(), stamp);
    if (at == truth.stamps.end() || (at != truth.stamps.begin() && stamp - *(at - 1) < *at - stamp))
      --at;
    if (std::abs(*at - stamp) <= tolerance)
      pairs.emplace_back(sequence.poses[i],
                         truth.poses[static_cast<std::size_t>(at - truth.stamps.begin())]);
  }
  return pairs;
}

struct Fit {
  double ratio = 1, error = 0;  ///< truth to odometry; mean relative difference
  std::size_t distances = 0;
};
Fit Compare(const std::vector<std::pair<Pose, Pose>>& pairs, bool inverse, int windows) {
  const std::size_t step = std::max<std::size_t>(1, pairs.size() / windows);
  std::vector<std::pair<double, double>> lengths;
  std::vector<double> given, ratios;
  for (std::size_t i = step; i < pairs.size(); i += step) {
    const auto place = [&](std::size_t k) {
      return Vec3((inverse ? pairs[k].second.inverse() : pairs[k].second).translation());
    };
    lengths.emplace_back(
        (pairs[i].first.translation() - pairs[i - step].first.translation()).norm(),
        (place(i) - place(i - step)).norm());
    given.push_back(lengths.back().first);
  }
  if (given.empty()) return {};
  const double least = kLeastDistance * Median(given);
  Fit fit;
  for (const auto& [odometry, truth] : lengths)
    if (odometry > least && odometry > 0) ratios.push_back(truth / odometry);
  if (ratios.empty()) return fit;
  fit.distances = ratios.size();
  fit.ratio = Median(ratios);
  for (const double ratio : ratios)
    fit.error += std::abs(ratio - fit.ratio) / std::max(ratio, fit.ratio) /
                 static_cast<double>(ratios.size());
  return fit;
}

/// The worst of several distances.
Fit WorstFit(const std::vector<std::pair<Pose, Pose>>& pairs, bool inverse) {
  Fit worst;
  for (const int windows : kWindows) {
    const Fit fit = Compare(pairs, inverse, windows);
    if (fit.distances >= kLeastDistances && fit.error >= worst.error) worst = fit;
  }
  return worst;
}

}  // namespace

Outcome CheckGroundTruth(const Sequence& sequence) {
  if (!sequence.groundtruth || sequence.groundtruth->poses.empty() || !sequence.has_odometry)
    return NotTestable("no ground truth");
  const auto pairs = Matched(sequence);
  const Fit fit = WorstFit(pairs, false), inverse = WorstFit(pairs, true);
  if (fit.distances == 0)
    return NotTestable("fewer than " + std::to_string(kLeastDistances) + " distances to compare");
  const std::string measured = "distances differ from the odometry's by " + Percent(fit.error) +
                               ", after a factor of " + Figure(fit.ratio, 3);
  if (fit.error > kInverseLeast && inverse.error < kInverseRatio * fit.error)
    return Found("groundtruth_inverse",
                 measured + "; with inverse poses by " + Percent(inverse.error), [](Sequence& s) {
                   for (Pose& pose : s.groundtruth->poses) pose = pose.inverse();
                 });
  if (fit.error > kOther) return Found("groundtruth_other", measured);
  if (fit.ratio > kUnits) {
    const double factor = fit.ratio > kMillis ? 0.001 : 0.01;
    return Found("groundtruth_units", measured, [factor](Sequence& s) {
      for (Pose& pose : s.groundtruth->poses) pose = Pose(pose.so3(), factor * pose.translation());
    });
  }
  if (const auto axes = FindBodyAxes(pairs))
    return Found("groundtruth_axes",
                 std::string("the motions are those of a body with ") + axes->name +
                     " (mean cosine " + Figure(axes->agrees) + ")",
                 [R = axes->R_cam_body](Sequence& s) {
                   const Pose T_body_cam(
                       lie::SO3<double>(Eigen::Quaterniond(Eigen::Matrix3d(R.transpose()))),
                       Vec3::Zero());
                   for (Pose& pose : s.groundtruth->poses) pose = pose * T_body_cam;
                 });
  return Ok(measured);
}

}  // namespace sslcd::check
