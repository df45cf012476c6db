// SPDX-License-Identifier: BSD-3-Clause
#include <lie/so3.h>

#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

#include "elements.h"

namespace lie::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(SO3, GroupAxioms) {
  const auto phis = Thin(RotationVectors(), 5);
  for (const auto& pa : phis) {
    const SO3d a = SO3d::Exp(pa);
    EXPECT_TRUE(Near(a * SO3d(), a, 1e-15));
    EXPECT_TRUE(Near(SO3d() * a, a, 1e-15));
    EXPECT_TRUE(Near(a * a.inverse(), SO3d(), 1e-15));
    EXPECT_TRUE(Near(a.inverse() * a, SO3d(), 1e-15));
    for (const auto& pb : phis) {
      const SO3d b = SO3d::Exp(pb);
      EXPECT_TRUE(Near((a * b).inverse(), b.inverse() * a.inverse(), 1e-15));
      EXPECT_TRUE(Near((a * b).matrix(), a.matrix() * b.matrix(), 5e-15));
      for (const auto& pc : phis) {
        const SO3d c = SO3d::Exp(pc);
        EXPECT_TRUE(Near((a * b) * c, a * (b * c), 2e-15));
      }
    }
  }
}

TEST(SO3, ExpIsTheMatrixExponential) {
  for (const auto& phi : RotationVectors()) {
    const Matrix3d expected = SO3d::hat(phi).exp();
    EXPECT_TRUE(Near(SO3d::Exp(phi).matrix(), expected, 1e-14)) << phi.transpose();
  }
}

TEST(SO3, LogUndoesExpBelowPi) {
  for (const auto& phi : RotationVectors(kPi - 1e-9)) {
    EXPECT_TRUE(Near(SO3d::Exp(phi).Log(), phi, 2e-15 * phi.norm())) << phi.transpose();
  }
}

TEST(SO3, ExpUndoesLog) {
  for (const auto& phi : RotationVectors()) {
    for (double turns : {0.0, 0.3, 1.0, 1.7}) {  // also rotations given by more than pi
      const SO3d R = SO3d::Exp(phi * (1 + turns));
      EXPECT_TRUE(Near(SO3d::Exp(R.Log()), R, 2e-15));
      EXPECT_TRUE(R.Log().norm() <= kPi + 1e-15);
    }
  }
}

TEST(SO3, LogAtPiIsOneOfTheTwo) {
  for (const auto& axis : Axes()) {
    Eigen::Quaterniond q(0.0, axis.x(), axis.y(), axis.z());  // exactly a half turn
    for (double w : {0.0, -0.0}) {
      q.w() = w;
      EXPECT_TRUE(Near(SO3d(q).Log(), kPi * axis, 1e-15));
    }
    q.w() = -1e-9;  // just over: the other way round
    EXPECT_TRUE(Near(SO3d(q).Log(), -(kPi - 2e-9) * axis, 1e-15));
  }
}

TEST(SO3, LogIgnoresTheCoverAndTheLength) {
  for (const auto& phi : RotationVectors(kPi - 1e-9)) {
    Eigen::Quaterniond q = SO3d::Exp(phi).unit_quaternion();
    q.coeffs() *= -3.0;
    EXPECT_TRUE(Near(SO3d(q).Log(), phi, 3e-15));
    EXPECT_TRUE(Near(SO3d::FromUnitQuaternion(q).Log(), phi, 3e-15));
  }
}

TEST(SO3, ActsLikeItsMatrix) {
  const Vector3d p(0.3, -2.0, 5.0);
  for (const auto& phi : RotationVectors()) {
    const SO3d R = SO3d::Exp(phi);
    EXPECT_TRUE(Near(R * p, R.matrix() * p, 1e-14));
    EXPECT_TRUE(Near(R * (p + p), R.matrix() * p * 2, 2e-14));
    EXPECT_TRUE(Near(R.matrix() * R.matrix().transpose(), Matrix3d::Identity(), 2e-15));
    EXPECT_TRUE(std::abs(R.matrix().determinant() - 1) <= 2e-15);
    EXPECT_TRUE(Near(SO3d::FromMatrix(R.matrix()), R, 2e-15));
  }
}

TEST(SO3, AxisHelpers) {
  EXPECT_TRUE(Near(SO3d::RotX(kPi / 2) * Vector3d::UnitY(), Vector3d::UnitZ(), 1e-15));
  EXPECT_TRUE(Near(SO3d::RotY(kPi / 2) * Vector3d::UnitZ(), Vector3d::UnitX(), 1e-15));
  EXPECT_TRUE(Near(SO3d::RotZ(kPi / 2) * Vector3d::UnitX(), Vector3d::UnitY(), 1e-15));
}

TEST(SO3, HatIsTheCrossProduct) {
  const Vector3d a(1, -2, 3), b(0.5, 4, -1);
  EXPECT_TRUE(Near(SO3d::hat(a) * b, a.cross(b), 1e-15));
  EXPECT_EQ(SO3d::vee(SO3d::hat(a)), a);
}

TEST(SO3, Adjoint) {
  const Vector3d d(0.2, -0.4, 0.1);
  for (const auto& phi : RotationVectors()) {
    const SO3d R = SO3d::Exp(phi);
    EXPECT_TRUE(Near(R * SO3d::Exp(d) * R.inverse(), SO3d::Exp(R.Adj() * d), 2e-15));
  }
}

TEST(SO3, JacobiansMatchDifferences) {
  const double h = 1e-5;
  for (const auto& phi : RotationVectors()) {
    const SO3d inverse = SO3d::Exp(phi).inverse();
    Matrix3d left, right;
    for (int i = 0; i < 3; ++i) {
      const SO3d plus = SO3d::Exp(phi + h * Vector3d::Unit(i)),
                 minus = SO3d::Exp(phi - h * Vector3d::Unit(i));
      left.col(i) = ((plus * inverse).Log() - (minus * inverse).Log()) / (2 * h);
      right.col(i) = ((inverse * plus).Log() - (inverse * minus).Log()) / (2 * h);
    }
    EXPECT_TRUE(Near(SO3d::LeftJacobian(phi), left, 1e-9)) << phi.transpose();
    EXPECT_TRUE(Near(SO3d::RightJacobian(phi), right, 1e-9)) << phi.transpose();
  }
}

TEST(SO3, JacobianIdentities) {
  for (const auto& phi : RotationVectors()) {
    const Matrix3d Jl = SO3d::LeftJacobian(phi), Jr = SO3d::RightJacobian(phi);
    EXPECT_TRUE(Near(Jl * SO3d::LeftJacobianInverse(phi), Matrix3d::Identity(), 5e-15));
    EXPECT_TRUE(Near(SO3d::RightJacobianInverse(phi) * Jr, Matrix3d::Identity(), 5e-15));
    EXPECT_TRUE(Near(Jl, SO3d::Exp(phi).matrix() * Jr, 5e-15));
    EXPECT_TRUE(Near(Jr, Jl.transpose(), 1e-15));
  }
}

TEST(SO3, LongChainsStayUnit) {
  const SO3d step = SO3d::Exp(Vector3d(0.01, -0.02, 0.03));
  SO3d R;
  for (int i = 0; i < 100000; ++i) R *= step;
  EXPECT_TRUE(std::abs(R.unit_quaternion().norm() - 1) <= 4e-16);
  R.data()[3] += 1.0;
  R.normalise();
  EXPECT_TRUE(std::abs(R.unit_quaternion().norm() - 1) <= 4e-16);
}

TEST(SO3, StorageAndCast) {
  static_assert(sizeof(SO3d) == 4 * sizeof(double) && alignof(SO3d) == alignof(double));
  const SO3d R(Eigen::Quaterniond(0.1, 0.2, 0.3, 0.4));  // w x y z
  const double n = std::sqrt(0.01 + 0.04 + 0.09 + 0.16);
  EXPECT_TRUE(Near(Eigen::Map<const Eigen::Vector4d>(R.data()),
                   Eigen::Vector4d(0.2, 0.3, 0.4, 0.1) / n, 1e-15));
  EXPECT_TRUE(Near(R.cast<float>().cast<double>(), R, 1e-7));
  EXPECT_TRUE(Near(R.cast<double>(), R, 0.0));
}

TEST(SO3, WorksInFloat) {
  for (const auto& phi : RotationVectors(kPi - 1e-5)) {
    const Eigen::Vector3f phi_f = phi.cast<float>();
    EXPECT_TRUE(Near(SO3<float>::Exp(phi_f).Log(), phi_f, 1e-6));
  }
}

TEST(SO3, BadInputGivesNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(SO3d::Exp(Vector3d(nan, 0, 0)).Log().norm()));
  EXPECT_TRUE(std::isnan(SO3d(Eigen::Quaterniond(0, 0, 0, 0)).matrix().norm()));
  EXPECT_FALSE(Near(SO3d::Exp(Vector3d(nan, 0, 0)), SO3d(), 1e9));
}

}  // namespace
}  // namespace lie::test
