// SPDX-License-Identifier: BSD-3-Clause

/// SE(3), the rigid motions of space: a rotation and a translation.
///
/// Conventions
///   storage      [qx qy qz qw tx ty tz], 7 contiguous scalars
///   action       T * p = R p + t
///   tangent      xi = [rho, phi]: translation first, then rotation. rho is not t:
///                t = J_l(phi) rho
///   perturbation on the right: T (+) d = T * Exp(d)
///   Jacobians    Exp(xi + d) = Exp(J_l(xi) d) Exp(xi) = Exp(xi) Exp(J_r(xi) d) to first
///                order in d. For r(d) = Log(A T Exp(d)), dr/dd at 0 is J_r^-1(r).
///
/// Scalars, dual numbers and sources [B], [S]: as in so3.h.
#pragma once

#include "lie/so3.h"

namespace lie {

template <class T>
class SE3 {
 public:
  using Scalar = T;
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  using Matrix3 = Eigen::Matrix<T, 3, 3>;
  /// Not aligned: a struct holding one has the same layout with and without -mavx. (The
  /// 3-vector and 3x3 matrix of double are never aligned by Eigen.)
  using Tangent = Eigen::Matrix<T, 6, 1, Eigen::DontAlign>;
  using Matrix6 = Eigen::Matrix<T, 6, 6, Eigen::DontAlign>;
  using Matrix4 = Eigen::Matrix<T, 4, 4, Eigen::DontAlign>;
  using Matrix34 = Eigen::Matrix<T, 3, 4, Eigen::DontAlign>;
  using Quaternion = typename SO3<T>::Quaternion;

  static constexpr int kDimension = 6;
  static constexpr int kParameters = 7;

  /// The identity.
  SE3() : t_(Vector3::Zero()) {}
  SE3(const SO3<T>& rotation, const Vector3& translation) : R_(rotation), t_(translation) {}

  /// The quaternion is normalised.
  template <class Derived>
  static SE3 FromQuaternionTranslation(const Eigen::QuaternionBase<Derived>& q,
                                       const Vector3& translation) {
    return SE3(SO3<T>(q), translation);
  }

  /// A 4x4 or 3x4 matrix [R t]; R as in SO3::FromMatrix, a last row is not read.
  template <class Derived>
  static SE3 FromMatrix(const Eigen::MatrixBase<Derived>& M) {
    static_assert(int(Derived::ColsAtCompileTime) == 4 && (int(Derived::RowsAtCompileTime) == 3 ||
                                                           int(Derived::RowsAtCompileTime) == 4),
                  "FromMatrix takes a 3x4 or a 4x4 matrix");
    return SE3(SO3<T>::FromMatrix(M.template block<3, 3>(0, 0)), M.template block<3, 1>(0, 3));
  }

  static SE3 Trans(const Vector3& t) { return SE3(SO3<T>(), t); }
  static SE3 Trans(const T& x, const T& y, const T& z) { return Trans(Vector3(x, y, z)); }
  static SE3 RotX(const T& angle_rad) { return SE3(SO3<T>::RotX(angle_rad), Vector3::Zero()); }
  static SE3 RotY(const T& angle_rad) { return SE3(SO3<T>::RotY(angle_rad), Vector3::Zero()); }
  static SE3 RotZ(const T& angle_rad) { return SE3(SO3<T>::RotZ(angle_rad), Vector3::Zero()); }

  /// R = Exp(phi), t = J_l(phi) rho: [S] eq. 172 and [B] sec. 7.1.
  static SE3 Exp(const Tangent& xi) {
    const Vector3 rho = xi.template head<3>();
    const Vector3 phi = xi.template tail<3>();
    return SE3(SO3<T>::Exp(phi), SO3<T>::LeftJacobian(phi) * rho);
  }

  /// phi = Log(R), rho = J_l(phi)^-1 t; |phi| <= pi. [S] app. D.
  Tangent Log() const {
    const Vector3 phi = R_.Log();
    Tangent xi;
    xi.template head<3>() = SO3<T>::LeftJacobianInverse(phi) * t_;
    xi.template tail<3>() = phi;
    return xi;
  }

  SE3 inverse() const {
    const SO3<T> R_inverse = R_.inverse();
    return SE3(R_inverse, -(R_inverse * t_));
  }

  SE3 operator*(const SE3& other) const { return SE3(R_ * other.R_, R_ * other.t_ + t_); }
  SE3& operator*=(const SE3& other) { return *this = *this * other; }

  /// Moves a point, a 3-vector; its scalar may be a plain one where T is a dual number.
  template <class Derived>
  Vector3 operator*(const Eigen::MatrixBase<Derived>& p) const {
    return R_ * p + t_;
  }

  Matrix34 matrix3x4() const {
    Matrix34 M;
    M.template leftCols<3>() = R_.matrix();
    M.col(3) = t_;
    return M;
  }

  Matrix4 matrix() const {
    Matrix4 M = Matrix4::Identity();
    M.template topRows<3>() = matrix3x4();
    return M;
  }

  /// Rotation and translation, to read or to assign. so3() and rotation() are the same.
  SO3<T>& so3() { return R_; }
  const SO3<T>& so3() const { return R_; }
  SO3<T>& rotation() { return R_; }
  const SO3<T>& rotation() const { return R_; }
  Vector3& translation() { return t_; }
  const Vector3& translation() const { return t_; }
  const Quaternion& unit_quaternion() const { return R_.unit_quaternion(); }

  /// T Exp(d) T^-1 = Exp(Adj d), Adj = [R  t^ R; 0  R]: [B] sec. 7.1, [S] app. D.
  Matrix6 Adj() const {
    const Matrix3 R = R_.matrix();
    return BlockTriangular(R, SO3<T>::hat(t_) * R);
  }

  /// The scalars in storage order. Who writes them keeps the quaternion's length at one, or
  /// calls normalise().
  T* data() { return R_.data(); }
  const T* data() const { return R_.data(); }

  void normalise() { R_.normalise(); }

  template <class U>
  SE3<U> cast() const {
    return SE3<U>(R_.template cast<U>(), t_.template cast<U>());
  }

  /// hat(xi) = [phi^  rho; 0  0], so that matrix(Exp(xi)) = expm(hat(xi)).
  static Matrix4 hat(const Tangent& xi) {
    Matrix4 M = Matrix4::Zero();
    M.template block<3, 3>(0, 0) = SO3<T>::hat(xi.template tail<3>());
    M.template block<3, 1>(0, 3) = xi.template head<3>();
    return M;
  }
  static Tangent vee(const Matrix4& M) {
    Tangent xi;
    xi.template head<3>() = M.template block<3, 1>(0, 3);
    xi.template tail<3>() = SO3<T>::vee(M.template block<3, 3>(0, 0));
    return xi;
  }

  /// J_l = [J  Q; 0  J] with J = SO3::LeftJacobian(phi): [B] eq. 7.85, [S] eq. 179.
  static Matrix6 LeftJacobian(const Tangent& xi) {
    const Matrix3 J = SO3<T>::LeftJacobian(xi.template tail<3>());
    return BlockTriangular(J, LeftQ(xi));
  }

  /// J_l^-1 = [J^-1  -J^-1 Q J^-1; 0  J^-1]: [B] eq. 7.95. Singular at |phi| = 2 pi k, k > 0.
  static Matrix6 LeftJacobianInverse(const Tangent& xi) {
    const Matrix3 J_inverse = SO3<T>::LeftJacobianInverse(xi.template tail<3>());
    return BlockTriangular(J_inverse, -J_inverse * LeftQ(xi) * J_inverse);
  }

  /// J_r(xi) = J_l(-xi).
  static Matrix6 RightJacobian(const Tangent& xi) { return LeftJacobian(-xi); }
  static Matrix6 RightJacobianInverse(const Tangent& xi) { return LeftJacobianInverse(-xi); }

 private:
  /// [A B; 0 A]
  static Matrix6 BlockTriangular(const Matrix3& A, const Matrix3& B) {
    Matrix6 M = Matrix6::Zero();
    M.template block<3, 3>(0, 0) = A;
    M.template block<3, 3>(0, 3) = B;
    M.template block<3, 3>(3, 3) = A;
    return M;
  }

  /// Q of [B] eq. 7.86, [S] eq. 180. Its last coefficient,
  /// (2 theta - 3 sin + theta cos) / (2 theta^5), is (c4 - 3 c5) / 2 in Stumpff functions.
  static Matrix3 LeftQ(const Tangent& xi) {
    const Matrix3 V = SO3<T>::hat(xi.template head<3>());
    const Matrix3 P = SO3<T>::hat(xi.template tail<3>());
    const Stumpff<T> c = EvaluateStumpff(T(xi.template tail<3>().squaredNorm()));
    const Matrix3 PV = P * V;
    const Matrix3 VP = V * P;
    const Matrix3 PVP = PV * P;
    return T(0.5) * V + c.c3 * (PV + VP + PVP) + c.c4 * (P * PV + VP * P - T(3.0) * PVP) +
           (T(0.5) * (c.c4 - T(3.0) * c.c5)) * (PVP * P + P * PVP);
  }

  SO3<T> R_;
  Vector3 t_;
};

using SE3d = SE3<double>;

static_assert(sizeof(SE3d) == 7 * sizeof(double) && alignof(SE3d) == alignof(double),
              "SE3d must be 7 contiguous doubles");

}  // namespace lie
