// SPDX-License-Identifier: BSD-3-Clause
#include "check/ground_truth_axes.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"

namespace sslcd::check {
namespace {

constexpr std::size_t kMotionsOfDrive = 100;  // of which the drive is made
constexpr std::size_t kLeastMotions = 20;
constexpr double kLeastMotion = 0.3;                        // of the median one
constexpr double kLeastTurn = 1;                            // in all [rad]
constexpr double kMostAsCamera = 0.5, kLeastAsBody = 0.95;  // mean cosines of directions
constexpr double kTurnTolerance = 0.2;                      // of the turns, as a share

struct FrameMotion {
  Vec3 odometry, truth, odometry_turn, truth_turn;  // in the axes of the moving frame
};

std::vector<FrameMotion> FrameMotions(const std::vector<std::pair<Pose, Pose>>& pairs) {
  const std::size_t step = std::max<std::size_t>(1, pairs.size() / kMotionsOfDrive);
  std::vector<FrameMotion> motions;
  std::vector<double> lengths;
  for (std::size_t i = step; i < pairs.size(); i += step) {
    const Pose odometry = pairs[i - step].first.inverse() * pairs[i].first;
    const Pose truth = pairs[i - step].second.inverse() * pairs[i].second;
    motions.push_back(
        {odometry.translation(), truth.translation(), odometry.so3().Log(), truth.so3().Log()});
    lengths.push_back(odometry.translation().norm());
  }
  if (motions.empty()) return motions;
  const double least = std::max(1e-6, kLeastMotion * Median(lengths));
  const auto stands = [least](const FrameMotion& motion) {
    return !(motion.odometry.norm() >= least && motion.truth.norm() > 1e-6);
  };
  motions.erase(std::remove_if(motions.begin(), motions.end(), stands), motions.end());
  return motions;
}

double MeanCosine(const std::vector<FrameMotion>& motions, const Eigen::Matrix3d& R_cam_body) {
  double sum = 0;
  for (const FrameMotion& motion : motions)
    sum += motion.odometry.normalized().dot(R_cam_body * motion.truth.normalized());
  return sum / static_cast<double>(motions.size());
}

// Whether the turns are those of the odometry, about the axis that the body's axes give them.
bool TurnsAgree(const std::vector<FrameMotion>& motions, const Eigen::Matrix3d& R_cam_body) {
  double common = 0, own = 0, all = 0;
  for (const FrameMotion& motion : motions) {
    common += motion.odometry_turn.dot(R_cam_body * motion.truth_turn);
    own += motion.odometry_turn.squaredNorm();
    all += motion.odometry_turn.norm();
  }
  return all >= kLeastTurn && std::abs(common / own - 1) < kTurnTolerance;
}

}  // namespace

std::optional<BodyAxes> FindBodyAxes(const std::vector<std::pair<Pose, Pose>>& pairs) {
  const std::vector<FrameMotion> motions = FrameMotions(pairs);
  if (motions.size() < kLeastMotions) return std::nullopt;
  if (MeanCosine(motions, Eigen::Matrix3d::Identity()) > kMostAsCamera) return std::nullopt;
  Eigen::Matrix3d ros, opengl = Vec3(1, -1, -1).asDiagonal();
  ros << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  for (const auto& [name, R_cam_body] : {std::pair("x forward, y left, z up", ros),
                                         std::pair("x right, y up, z backward", opengl)}) {
    const double cosine = MeanCosine(motions, R_cam_body);
    if (cosine > kLeastAsBody && TurnsAgree(motions, R_cam_body))
      return BodyAxes{name, R_cam_body, cosine};
  }
  return std::nullopt;
}

}  // namespace sslcd::check
