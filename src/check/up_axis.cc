// SPDX-License-Identifier: BSD-3-Clause
#include "check/up_axis.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace sslcd::check {
namespace {

constexpr int kLeastPlaced = 50;
constexpr double kFlatness = 0.2;  // standard deviations: across the plane to along it
constexpr double kOff = 0.5, kUpright = 0.866, kOpposite = -0.866;  // cosines

std::string AxisText(const Vec3& axis) {
  return "[" + Figure(axis.x()) + ", " + Figure(axis.y()) + ", " + Figure(axis.z()) + "]";
}

/// The normal of the plane in which the objects of a frame and the camera lie, over all frames.
struct Ground {
  Vec3 normal = Vec3::Zero();
  double flatness = 1;
  int objects = 0;
};
Ground FitGround(const Sequence& sequence) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Ground ground;
  for (const auto& rows : RowsByFrame(sequence)) {
    if (rows.size() < 2) continue;
    Vec3 mean = Vec3::Zero();
    std::vector<Vec3> places;
    for (const Row* row : rows) {
      const Pose& camera = sequence.poses[static_cast<std::size_t>(row->frame)];
      places.push_back(camera.so3() * row->detection.T_cam_object.translation());
      mean += places.back() / static_cast<double>(rows.size());
    }
    for (const Vec3& place : places) sum += (place - mean) * (place - mean).transpose();
    ground.objects += static_cast<int>(rows.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum);
  const Vec3 values = eigen.eigenvalues().cwiseMax(0);
  ground.normal = eigen.eigenvectors().col(0);
  if (values[1] > 0) ground.flatness = std::sqrt(values[0] / values[1]);
  return ground;
}

}  // namespace

Outcome CheckUpAxis(const Sequence& sequence) {
  if (!sequence.has_odometry) return NotTestable("no odometry is given");
  const Ground ground = FitGround(sequence);
  if (ground.objects < kLeastPlaced || ground.flatness > kFlatness)
    return NotTestable("fewer than " + std::to_string(kLeastPlaced) +
                       " objects on one ground, seen together");
  Vec3 camera_up = Vec3::Zero();
  for (const Pose& pose : sequence.poses) camera_up -= pose.so3() * Vec3(Vec3::UnitY());
  camera_up /= static_cast<double>(sequence.poses.size());
  const Vec3 normal = ground.normal.dot(camera_up) < 0 ? Vec3(-ground.normal) : ground.normal;
  const double upright = normal.dot(camera_up), declared = normal.dot(sequence.up_axis);
  const std::string measured = "the ground's normal on the camera's upper side is " +
                               AxisText(normal) + ", up_axis is " + AxisText(sequence.up_axis);
  if (upright < kUpright) return Ok(measured + "; the camera is not upright");
  if (declared > kOpposite && std::abs(declared) > kOff) return Ok(measured);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Vec3 up = Vec3::Zero();
  up[axis] = normal[axis] > 0 ? 1 : -1;
  if (up.dot(normal) < kUpright) up = normal;
  return Found("up_axis", measured, [up](Sequence& s) { s.up_axis = up; });
}

}  // namespace sslcd::check
