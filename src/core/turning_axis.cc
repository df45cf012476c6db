// SPDX-License-Identifier: BSD-3-Clause
#include "core/turning_axis.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace sslcd {
namespace {

// Turns are taken between cameras that are turned by this, so that jitter does not count. [rad]
constexpr double kTurn = 0.2;
constexpr double kLeastTurned = M_PI;  // in all
constexpr double kLeastShare = 0.7;    // of the turns that are about the axis
constexpr double kLeastCosine = 0.5;   // between the axis and up

}  // namespace

std::optional<Vec3> TurningAxis(const std::vector<Pose>& cameras) {
  Eigen::Matrix3d turns = Eigen::Matrix3d::Zero();
  Vec3 camera_up = Vec3::Zero();
  const Pose* last = nullptr;
  for (const Pose& camera : cameras) {
    camera_up -= camera.so3() * Vec3(Vec3::UnitY());
    if (last == nullptr) last = &camera;
    const Vec3 turn = (camera.so3() * last->so3().inverse()).Log();
    if (turn.norm() < kTurn) continue;
    turns += turn * turn.transpose() / turn.norm();
    last = &camera;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(turns);
  if (turns.trace() < kLeastTurned || eigen.eigenvalues()[2] < kLeastShare * turns.trace())
    return std::nullopt;
  const Vec3 axis = eigen.eigenvectors().col(2);
  return axis.dot(camera_up) < 0 ? Vec3(-axis) : axis;
}

bool MayBeUp(const Vec3& up, const std::vector<Pose>& cameras) {
  const std::optional<Vec3> axis = TurningAxis(cameras);
  return !axis || std::abs(axis->dot(up)) >= kLeastCosine;
}

}  // namespace sslcd
