// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lie/se3.h>
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

/// Rigid transform. `T_a_b` maps points of frame b to frame a.
/// Storage [qx qy qz qw tx ty tz], tangent order [rho (translation), phi (rotation)], right
/// perturbation `T * Exp(d)`.
using Pose = lie::SE3<double>;
using Vec2 = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
using Vec3 = Eigen::Vector3d;
using Vec6 = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;

/// Largest |R^T R - I| or ||q| - 1| of a rotation from outside; rounding errors are smaller.
constexpr double kRotationTolerance = 1e-2;

/// [R t] with R replaced by the nearest rotation. None if R differs from it by more than the
/// tolerance, is a reflection, or a value is not finite.
std::optional<Pose> RigidFromMatrix(const Eigen::Matrix3d& R, const Vec3& t);

/// Angle wrapped to (-pi, pi]. [rad]
double WrapAngle(double angle_rad);

/// Angle wrapped to (-period/2, period/2]; period > 0. [rad]
double WrapAngle(double angle_rad, double period_rad);

/// A gravity-aligned frame: the up direction and the two horizontal axes of the yaw. Yaw is the
/// angle about `up`, counter-clockwise seen from above, from `forward` towards `left` (`left` = up
/// x forward). KITTI camera axes: up = -y; VINS worlds: up = +z.
struct GravityFrame {
  Vec3 up{0, -1, 0};  ///< unit vectors in the world
  Vec3 forward{1, 0, 0};
  Vec3 left{0, 0, 1};

  /// The frame for a given up direction (any finite non-zero vector; normalised here, otherwise
  /// Error(kBadInput)). For an axis-aligned `up`, `forward` is another axis of the world: x for up
  /// = -y or +z.
  static GravityFrame FromUp(const Vec3& up);

  /// Columns [forward left up]: rotates vectors from this frame to the world.
  Eigen::Matrix3d Basis() const;

  /// R_world_object of an upright object (x along its length, z up) with a yaw [rad].
  lie::SO3<double> Upright(double yaw_rad) const;

  /// Yaw of a rotation: direction of its x axis projected to the horizontal. [rad]
  double YawOf(const lie::SO3<double>& R_world_object) const;
};

/// The pose of a gravity-aligned object: its centre and heading. Roll and pitch are zero (paper
/// III-A.1).
struct UprightPose {
  Vec3 position{0, 0, 0};  ///< centre in the world [m]
  double yaw = 0;          ///< heading about the world's up, see GravityFrame [rad]
};

/// T_world_object.
Pose ToPose(const UprightPose& upright, const GravityFrame& gravity);
/// Drops roll and pitch.
UprightPose ToUpright(const Pose& T_world_object, const GravityFrame& gravity);

/// A measured pose of one camera in another one's frame.
struct RelativePose {
  Pose T_a_b;
  /// covariance of the right perturbation T_a_b Exp(d), d = [translation, rotation]
  Pose::Matrix6 covariance = Pose::Matrix6::Identity();
};

/// T_a_c from T_a_b and T_b_c with independent errors.
inline RelativePose Compose(const RelativePose& ab, const RelativePose& bc) {
  // T_a_b Exp(d) T_b_c = T_a_b T_b_c Exp(Adj(T_b_c^-1) d)
  const Pose::Matrix6 adjoint = bc.T_a_b.inverse().Adj();
  return {ab.T_a_b * bc.T_a_b, adjoint * ab.covariance * adjoint.transpose() + bc.covariance};
}

/// Whether `T_a_b` lies within the measurement's confidence region of the given probability.
bool Agrees(const RelativePose& measured, const Pose& T_a_b, double probability);

/// What an odometry reports of one of its steps, from the frame before to this one. It adds to the
/// noise that is assumed of every step.
struct StepUncertainty {
  /// The step is unknown, because tracking failed: position and heading are those of any place.
  bool lost = false;
  /// standard deviations of the step's translation, along each axis [m], and of its rotation, about
  /// each axis [rad]; finite, >= 0; not used where `lost` is set
  double translation_m = 0, rotation_rad = 0;
};

/// Whether both standard deviations are finite and not negative.
bool IsValid(const StepUncertainty& step);

/// Stamped poses in order of time. `poses[i]` is T_world_cam at `stamps[i]` [s]; both have the same
/// length.
struct Trajectory {
  std::vector<double> stamps;
  std::vector<Pose> poses;
  std::size_t size() const { return poses.size(); }
};

}  // namespace sslcd
