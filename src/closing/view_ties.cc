// SPDX-License-Identifier: BSD-3-Clause
#include "closing/view_ties.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/finite.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

/// The ground point at `ahead_m` ahead of a camera.
Vec3 GroundPointAhead(const FrameRecord& frame, double ahead_m) {
  return frame.T_world_cam * Vec3(0, 0, ahead_m);
}

/// The earlier camera of another pass whose ground point is nearest to that of frame `i`; -1: none.
/// `reach_m` is the largest path between them with closed loops as shortcuts.
int FindOverlappingView(const FrameStore& frames, int i, const PathGraph& path, double reach_m,
                        const LoopViewOptions& options) {
  const Vec3 ground_point = GroundPointAhead(frames[i], options.ahead_m);
  const PathGraph::Distances drift = path.From(frames[i].travelled);
  double nearest = options.apart_m;
  int found = -1;
  for (int k = 0; k < i && frames[i].travelled - frames[k].travelled >= options.gap_m; ++k) {
    const double apart = (GroundPointAhead(frames[k], options.ahead_m) - ground_point).norm();
    if (apart > nearest || drift.To(frames[k].travelled) > reach_m) continue;
    nearest = apart;
    found = k;
  }
  return found;
}

bool IsMeasurement(const RelativePose& pose) {
  constexpr double kLeastVariance = 1e-12;  // a smaller variance is rounding error [m^2, rad^2]
  if (!IsPose(pose.T_a_b) || !pose.covariance.allFinite()) return false;
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> ldlt(pose.covariance);
  return ldlt.info() == Eigen::Success && ldlt.vectorD().minCoeff() > kLeastVariance;
}

}  // namespace

double PathUntilDrift(const OdometryNoise& noise, double off_m) {
  constexpr double kStep = 5, kLongest = 10000;  // resolution and end of the answer [m]
  double path = 0;
  // A random walk of the heading of s per sqrt(m) moves the camera by s L^1.5 / sqrt(3) after L
  // metres.
  const auto off = [&](double length) {
    return std::hypot(noise.translation_floor_m, noise.translation_walk * std::sqrt(length),
                      noise.rotation_walk * std::pow(length, 1.5) / std::sqrt(3.));
  };
  while (path < kLongest && off(path + kStep) <= off_m) path += kStep;
  return path;
}

std::vector<ViewTie> TieViews(const FrameStore& frames, const PathGraph& path,
                              const ViewAligner& align, const LoopOptions& loop_options) {
  const LoopViewOptions& options = loop_options.views;
  const double reach_m =
      std::max(options.reach_m, PathUntilDrift(loop_options.odometry, options.guess_m));
  std::vector<ViewTie> tried;
  std::vector<ViewPair> pairs;
  double last_m = -options.every_m;
  for (int i = 0; i < frames.size(); ++i) {
    if (frames[i].travelled - last_m < options.every_m) continue;
    const int old = FindOverlappingView(frames, i, path, reach_m, options);
    if (old < 0) continue;
    last_m = frames[i].travelled;
    tried.push_back({old, i, {}});
    pairs.push_back({frames[old].frame, frames[i].frame,
                     frames[old].T_world_cam.inverse() * frames[i].T_world_cam});
  }
  if (pairs.empty()) return {};
  const std::vector<std::optional<RelativePose>> answers = align(pairs);
  if (answers.size() != pairs.size())
    throw Error(ErrorKind::kBadInput, {"view aligner"},
                "gave " + std::to_string(answers.size()) + " answers for " +
                    std::to_string(pairs.size()) + " pairs of frames: it must give one each");
  std::vector<ViewTie> ties;
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (answers[i] && IsMeasurement(*answers[i]))
      ties.push_back({tried[i].from, tried[i].to, *answers[i]});
  return ties;
}

std::vector<ViewTie> AgreeingTies(const std::vector<ViewTie>& ties, const FrameStore& frames) {
  constexpr double kProbability = 0.999;  // of the chi-square test, 6 DoF; set by hand
  std::vector<ViewTie> agreeing;
  for (const ViewTie& tie : ties) {
    const Pose T_from_to = frames[tie.from].T_world_cam.inverse() * frames[tie.to].T_world_cam;
    if (Agrees(tie.pose, T_from_to, kProbability)) agreeing.push_back(tie);
  }
  return agreeing;
}

}  // namespace sslcd
