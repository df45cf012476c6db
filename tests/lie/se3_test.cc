// SPDX-License-Identifier: BSD-3-Clause
#include <lie/se3.h>

#include <unsupported/Eigen/MatrixFunctions>

#include "elements.h"

namespace lie::test {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Tangent = SE3d::Tangent;

/// ad(xi) with Adj(Exp(xi)) = expm(ad(xi)).
Matrix6d SmallAdjoint(const Tangent& xi) {
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = SO3d::hat(xi.tail<3>());
  ad.topRightCorner<3, 3>() = SO3d::hat(xi.head<3>());
  return ad;
}

TEST(SE3, GroupAxioms) {
  const auto twists = Thin(Twists(), 23);
  for (const auto& xa : twists) {
    const SE3d a = SE3d::Exp(xa);
    EXPECT_TRUE(Near(a * SE3d(), a, 1e-15));
    EXPECT_TRUE(Near(SE3d() * a, a, 1e-15));
    EXPECT_TRUE(Near(a * a.inverse(), SE3d(), 1e-14));
    EXPECT_TRUE(Near(a.inverse() * a, SE3d(), 1e-14));
    for (const auto& xb : twists) {
      const SE3d b = SE3d::Exp(xb);
      EXPECT_TRUE(Near((a * b).inverse(), b.inverse() * a.inverse(), 3e-14));
      EXPECT_TRUE(Near((a * b).matrix(), a.matrix() * b.matrix(), 3e-14));
      for (const auto& xc : twists) {
        const SE3d c = SE3d::Exp(xc);
        EXPECT_TRUE(Near((a * b) * c, a * (b * c), 5e-14));
      }
    }
  }
}

TEST(SE3, ExpIsTheMatrixExponential) {
  for (const auto& xi : Twists()) {
    const Matrix4d expected = Matrix4d(SE3d::hat(xi)).exp();
    EXPECT_TRUE(Near(SE3d::Exp(xi).matrix(), expected, 3e-14)) << xi.transpose();
  }
}

TEST(SE3, LogUndoesExpBelowPi) {
  for (const auto& xi : Twists(kPi - 1e-9)) {
    EXPECT_TRUE(Near(SE3d::Exp(xi).Log(), xi, 1e-14 * xi.norm())) << xi.transpose();
  }
}

TEST(SE3, ExpUndoesLog) {
  for (const auto& xi : Twists()) {
    const SE3d T = SE3d::Exp(1.4 * xi);
    EXPECT_TRUE(Near(SE3d::Exp(T.Log()), T, 3e-14)) << xi.transpose();
  }
}

TEST(SE3, ActsLikeItsMatrix) {
  const Vector3d p(0.3, -2.0, 5.0);
  for (const auto& xi : Twists()) {
    const SE3d T = SE3d::Exp(xi);
    EXPECT_TRUE(Near(T * p, (T.matrix() * p.homogeneous()).head<3>(), 1e-14));
    EXPECT_TRUE(Near(T.matrix3x4(), T.matrix().topRows<3>(), 0.0));
    EXPECT_TRUE(Near(SE3d::FromMatrix(T.matrix()), T, 3e-15));
    EXPECT_TRUE(Near(SE3d::FromMatrix(T.matrix3x4()), T, 3e-15));
    EXPECT_TRUE(
        Near(SE3d::FromQuaternionTranslation(T.unit_quaternion(), T.translation()), T, 1e-15));
  }
}

TEST(SE3, HelpersAndParts) {
  const Vector3d t(1, 2, 3);
  SE3d T = SE3d::Trans(t) * SE3d::RotZ(kPi / 2);
  EXPECT_TRUE(Near(T * Vector3d::UnitX(), Vector3d(1, 3, 3), 1e-15));
  EXPECT_TRUE(Near(SE3d::RotX(0.2).so3(), SO3d::RotX(0.2), 0.0));
  EXPECT_TRUE(Near(SE3d::RotY(0.2).so3(), SO3d::RotY(0.2), 0.0));
  EXPECT_TRUE(Near(SE3d::Trans(1, 2, 3), SE3d::Trans(t), 0.0));
  T.translation() = -t;
  T.rotation() = SO3d::RotX(0.5);
  EXPECT_TRUE(Near(T, SE3d(SO3d::RotX(0.5), -t), 0.0));
  T *= T.inverse();
  EXPECT_TRUE(Near(T, SE3d(), 1e-15));
  T.so3().data()[3] = 2.0;
  T.normalise();
  EXPECT_TRUE(Near(T, SE3d(), 0.0));
}

TEST(SE3, HatAndVee) {
  const Tangent xi = (Tangent() << 1, 2, 3, -4, 5, 6).finished();
  EXPECT_EQ(SE3d::vee(SE3d::hat(xi)), xi);
  EXPECT_EQ(Vector3d(SE3d::hat(xi).topRightCorner<3, 1>()), Vector3d(1, 2, 3));
}

TEST(SE3, Adjoint) {
  const Tangent d = (Tangent() << 0.3, 0.1, -0.2, 0.2, -0.4, 0.1).finished();
  for (const auto& xi : Twists()) {
    const SE3d T = SE3d::Exp(xi);
    EXPECT_TRUE(Near(T * SE3d::Exp(d) * T.inverse(), SE3d::Exp(T.Adj() * d), 3e-14));
    const Matrix6d expected = SmallAdjoint(xi).exp();
    EXPECT_TRUE(Near(T.Adj(), expected, 1e-13));
  }
}

// J_l = sum_n ad^n / (n + 1)!, Barfoot eq. 7.83: no differences, so to rounding.
TEST(SE3, LeftJacobianMatchesItsSeries) {
  for (const auto& xi : Twists()) {
    Matrix6d term = Matrix6d::Identity(), sum = Matrix6d::Zero();
    const Matrix6d ad = SmallAdjoint(xi);
    for (int n = 1; n <= 60; ++n) {
      sum += term;
      term = term * ad / (n + 1);
    }
    EXPECT_TRUE(Near(SE3d::LeftJacobian(xi), sum, 3e-14 * (1 + xi.norm()))) << xi.transpose();
  }
}

TEST(SE3, JacobiansMatchDifferences) {
  const double h = 1e-5;
  for (const auto& xi : Twists()) {
    const SE3d inverse = SE3d::Exp(xi).inverse();
    Matrix6d left, right;
    for (int i = 0; i < 6; ++i) {
      const SE3d plus = SE3d::Exp(xi + h * Tangent::Unit(i)),
                 minus = SE3d::Exp(xi - h * Tangent::Unit(i));
      left.col(i) = ((plus * inverse).Log() - (minus * inverse).Log()) / (2 * h);
      right.col(i) = ((inverse * plus).Log() - (inverse * minus).Log()) / (2 * h);
    }
    EXPECT_TRUE(Near(SE3d::LeftJacobian(xi), left, 1e-8)) << xi.transpose();
    EXPECT_TRUE(Near(SE3d::RightJacobian(xi), right, 1e-8)) << xi.transpose();
  }
}

TEST(SE3, JacobianIdentities) {
  for (const auto& xi : Twists()) {
    const Matrix6d Jl = SE3d::LeftJacobian(xi), Jr = SE3d::RightJacobian(xi);
    const double tol = 2e-14 * (1 + xi.norm());
    EXPECT_TRUE(Near(Jl * SE3d::LeftJacobianInverse(xi), Matrix6d::Identity(), tol));
    EXPECT_TRUE(Near(SE3d::RightJacobianInverse(xi) * Jr, Matrix6d::Identity(), tol));
    EXPECT_TRUE(Near(Jl, SE3d::Exp(xi).Adj() * Jr, tol));
  }
}

TEST(SE3, StorageAndCast) {
  SE3d T(SO3d::RotX(0.4), Vector3d(1, 2, 3));
  const double s = std::sin(0.2), c = std::cos(0.2);
  const double expected[7] = {s, 0, 0, c, 1, 2, 3};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(T.data()[i], expected[i], 1e-15);
  T.data()[6] = 9;
  EXPECT_EQ(T.translation().z(), 9);
  EXPECT_TRUE(Near(T.cast<float>().cast<double>(), T, 1e-7));
}

}  // namespace
}  // namespace lie::test
