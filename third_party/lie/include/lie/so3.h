// SPDX-License-Identifier: BSD-3-Clause

/// SO(3), the rotations of space, as unit quaternions.
///
/// Conventions
///   storage      [qx qy qz qw], Hamilton; q and -q are the same rotation
///   action       R * p turns the vector p
///   tangent      phi = angle * axis, in radians
///   perturbation on the right: R (+) d = R * Exp(d)
///   Jacobians    Exp(phi + d) = Exp(J_l(phi) d) Exp(phi) = Exp(phi) Exp(J_r(phi) d) to
///                first order in d
///
/// T is float, double or a dual number such as ceres::Jet. All branches are on the value
/// alone and both sides agree to second order and beyond, so derivatives are right
/// everywhere, also at exactly zero. Log is discontinuous at the angle pi by nature: there
/// it returns one of the two logarithms, and its derivative is that of the branch taken.
///
/// Sources
///   [B] T. Barfoot, State Estimation for Robotics, Cambridge 2017, chapter 7
///   [S] J. Sola, J. Deray, D. Atchuthan, A micro Lie theory for state estimation in
///       robotics, arXiv:1812.01537, appendix B
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "lie/stumpff.h"

namespace lie {

template <class T>
class SO3 {
 public:
  using Scalar = T;
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  using Matrix3 = Eigen::Matrix<T, 3, 3>;
  using Tangent = Vector3;
  /// Not aligned: a struct holding one has the same layout with and without -mavx.
  using Quaternion = Eigen::Quaternion<T, Eigen::DontAlign>;

  static constexpr int kDimension = 3;
  static constexpr int kParameters = 4;

  /// The identity.
  SO3() : q_(T(1.0), T(0.0), T(0.0), T(0.0)) {}

  /// Any quaternion but zero (which gives NaN); normalised here.
  template <class Derived>
  explicit SO3(const Eigen::QuaternionBase<Derived>& q) : q_(q) {
    normalise();
  }

  /// A quaternion that is of unit length already; kept bit by bit.
  template <class Derived>
  static SO3 FromUnitQuaternion(const Eigen::QuaternionBase<Derived>& q) {
    SO3 result;
    result.q_ = q;
    return result;
  }

  /// R must be orthonormal with determinant +1 up to rounding; it is not checked.
  static SO3 FromMatrix(const Matrix3& R) { return SO3(Quaternion(R)); }

  static SO3 RotX(const T& angle_rad) { return Exp(Vector3(angle_rad, T(0.0), T(0.0))); }
  static SO3 RotY(const T& angle_rad) { return Exp(Vector3(T(0.0), angle_rad, T(0.0))); }
  static SO3 RotZ(const T& angle_rad) { return Exp(Vector3(T(0.0), T(0.0), angle_rad)); }

  /// q = (cos(theta/2), sin(theta/2) phi/theta) with theta = |phi|, any angle: [S] app. B.
  static SO3 Exp(const Tangent& phi) {
    const Stumpff<T> half = EvaluateStumpff(T(phi.squaredNorm() * T(0.25)));
    const T k = T(0.5) * half.c1;
    SO3 result;
    result.q_ = Quaternion(half.c0, k * phi.x(), k * phi.y(), k * phi.z());
    return result;
  }

  /// The shortest phi with Exp(phi) = R, |phi| <= pi: theta = 2 atan2(|v|, w), [S] app. B.
  /// Never uses acos, so it loses no digits near 0 or near pi. Independent of the length of
  /// the quaternion.
  Tangent Log() const {
    using std::atan2;
    using std::sqrt;
    Vector3 v = q_.vec();
    T w = q_.w();
    if (w < T(0.0)) {  // the other cover of the same rotation is the shorter way round
      v = -v;
      w = -w;
    }
    const T n2 = v.squaredNorm();
    if (n2 < T(0.04) * w * w) {
      const T k = T(2.0) * AtanOverX(T(n2 / (w * w))) / w;
      return v * k;
    }
    const T n = sqrt(n2);
    const T k = T(2.0) * atan2(n, w) / n;
    return v * k;
  }

  SO3 inverse() const { return FromUnitQuaternion(q_.conjugate()); }

  /// One Newton step towards unit length follows each product, so chains do not drift.
  SO3 operator*(const SO3& other) const {
    SO3 result = FromUnitQuaternion(q_ * other.q_);
    const T scale = T(1.5) - T(0.5) * result.q_.squaredNorm();
    result.q_.coeffs() *= scale;
    return result;
  }
  SO3& operator*=(const SO3& other) { return *this = *this * other; }

  /// Turns a 3-vector; its scalar may be a plain one where T is a dual number.
  template <class Derived>
  Vector3 operator*(const Eigen::MatrixBase<Derived>& p) const {
    EIGEN_STATIC_ASSERT_VECTOR_SPECIFIC_SIZE(Derived, 3)
    const Vector3 v = p.template cast<T>();
    return q_._transformVector(v);
  }

  Matrix3 matrix() const { return q_.toRotationMatrix(); }
  const Quaternion& unit_quaternion() const { return q_; }

  /// R Exp(d) R^-1 = Exp(Adj d). For SO(3) it is the rotation matrix.
  Matrix3 Adj() const { return matrix(); }

  /// The scalars in storage order. Who writes them keeps the length at one, or calls
  /// normalise().
  T* data() { return q_.coeffs().data(); }
  const T* data() const { return q_.coeffs().data(); }

  void normalise() {
    using std::sqrt;
    const T scale = T(1.0) / sqrt(q_.squaredNorm());
    q_.coeffs() *= scale;
  }

  template <class U>
  SO3<U> cast() const {
    return SO3<U>::FromUnitQuaternion(q_.template cast<U>());
  }

  /// hat(a) b = a x b.
  static Matrix3 hat(const Tangent& v) {
    Matrix3 M;
    M << T(0.0), -v.z(), v.y(), v.z(), T(0.0), -v.x(), -v.y(), v.x(), T(0.0);
    return M;
  }
  /// Reads the lower triangle's three entries; the rest is not checked.
  static Tangent vee(const Matrix3& M) { return Tangent(M(2, 1), M(0, 2), M(1, 0)); }

  /// J_l = I + (1-cos)/theta^2 phi^ + (theta-sin)/theta^3 phi^ phi^: [B] sec. 7.1, [S] app. B.
  static Matrix3 LeftJacobian(const Tangent& phi) {
    const Stumpff<T> c = EvaluateStumpff(T(phi.squaredNorm()));
    const Matrix3 P = hat(phi);
    return Matrix3::Identity() + c.c2 * P + c.c3 * (P * P);
  }

  /// J_l^-1 = I - phi^/2 + (1/theta^2 - (1+cos)/(2 theta sin)) phi^ phi^: [B], [S] ditto. The
  /// last coefficient equals (c3 - 2 c4) / (2 c2): regular at 0 and at pi, singular, like
  /// J_l itself, only at multiples of 2 pi other than 0.
  static Matrix3 LeftJacobianInverse(const Tangent& phi) {
    const Stumpff<T> c = EvaluateStumpff(T(phi.squaredNorm()));
    const Matrix3 P = hat(phi);
    const T k = (c.c3 - T(2.0) * c.c4) / (T(2.0) * c.c2);
    return Matrix3::Identity() - T(0.5) * P + k * (P * P);
  }

  /// J_r(phi) = J_l(-phi).
  static Matrix3 RightJacobian(const Tangent& phi) { return LeftJacobian(-phi); }
  static Matrix3 RightJacobianInverse(const Tangent& phi) { return LeftJacobianInverse(-phi); }

 private:
  Quaternion q_;
};

using SO3d = SO3<double>;

}  // namespace lie
