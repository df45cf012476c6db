// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "core/math.h"
#include "sslcd/core/error.h"

namespace sslcd {

std::optional<Pose> RigidFromMatrix(const Eigen::Matrix3d& R, const Vec3& t) {
  if (!R.allFinite() || !t.allFinite()) return std::nullopt;
  if ((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() > kRotationTolerance ||
      R.determinant() < 0) {
    return std::nullopt;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  return Pose(lie::SO3<double>::FromMatrix(nearest), t);
}

double WrapAngle(double angle_rad, double period_rad) {
  // exact for axes
  if (-0.5 * period_rad < angle_rad && angle_rad <= 0.5 * period_rad) return angle_rad;
  double wrapped = std::fmod(angle_rad + 0.5 * period_rad, period_rad);
  if (wrapped <= 0) wrapped += period_rad;
  return wrapped - 0.5 * period_rad;
}

double WrapAngle(double angle_rad) { return WrapAngle(angle_rad, 2 * M_PI); }

GravityFrame GravityFrame::FromUp(const Vec3& up) {
  if (!up.allFinite() || up.isZero(0))
    throw Error(ErrorKind::kBadInput, "the up direction is zero or not finite");
  GravityFrame frame;
  frame.up = up.normalized();
  // Forward is x unless up is (nearly) x. The horizontal axes are (x, z) for KITTI and (x, y) for
  // VINS.
  const Vec3 candidate = std::abs(frame.up.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  frame.forward = (candidate - frame.up * frame.up.dot(candidate)).normalized();
  frame.left = frame.up.cross(frame.forward);
  return frame;
}

Eigen::Matrix3d GravityFrame::Basis() const {
  Eigen::Matrix3d basis;
  basis << forward, left, up;
  return basis;
}

lie::SO3<double> GravityFrame::Upright(double yaw_rad) const {
  const Eigen::Matrix3d R = Basis() * Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()).toRotationMatrix();
  return lie::SO3<double>::FromMatrix(R);
}

double GravityFrame::YawOf(const lie::SO3<double>& R_world_object) const {
  const Vec3 heading = R_world_object * Vec3(Vec3::UnitX());
  return std::atan2(heading.dot(left), heading.dot(forward));
}

Pose ToPose(const UprightPose& upright, const GravityFrame& gravity) {
  return Pose(gravity.Upright(upright.yaw), upright.position);
}

UprightPose ToUpright(const Pose& T_world_object, const GravityFrame& gravity) {
  return {T_world_object.translation(), gravity.YawOf(T_world_object.so3())};
}

bool IsValid(const StepUncertainty& step) {
  return std::isfinite(step.translation_m) && step.translation_m >= 0 &&
         std::isfinite(step.rotation_rad) && step.rotation_rad >= 0;
}

bool Agrees(const RelativePose& measured, const Pose& T_a_b, double probability) {
  const Vec6 error = (measured.T_a_b.inverse() * T_a_b).Log();
  const Eigen::Matrix<double, 6, 6> covariance = measured.covariance;
  return error.dot(covariance.ldlt().solve(error)) < Chi2Quantile(probability, 6);
}

}  // namespace sslcd
