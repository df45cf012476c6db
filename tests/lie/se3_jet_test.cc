// SPDX-License-Identifier: BSD-3-Clause
// Derivatives through dual numbers, against the analytic Jacobians and central differences.
#include <ceres/jet.h>
#include <lie/se3.h>

#include "elements.h"

namespace lie::test {
namespace {

using Eigen::Vector3d;
using Jet = ceres::Jet<double, 6>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Tangent = SE3d::Tangent;

/// Values and derivatives of a vector of dual numbers.
template <int N>
struct Split {
  Eigen::Matrix<double, N, 1> value;
  Eigen::Matrix<double, N, 6> jacobian;
};
template <class D>
Split<D::RowsAtCompileTime> SplitJets(const Eigen::MatrixBase<D>& jets) {
  Split<D::RowsAtCompileTime> s;
  for (int i = 0; i < jets.size(); ++i) {
    s.value[i] = jets[i].a;
    s.jacobian.row(i) = jets[i].v.transpose();
  }
  return s;
}

/// xi + d with the derivative of d at `values`.
SE3<Jet>::Tangent Variables(const Tangent& values) {
  SE3<Jet>::Tangent x;
  for (int i = 0; i < 6; ++i) x[i] = Jet(values[i], i);
  return x;
}

/// Elements A, B whose relative element A^-1 B is Exp(xi).
struct Pair {
  SE3d A, B;
};
Pair MakePair(const Tangent& xi) {
  const SE3d A = SE3d::Exp((Tangent() << 2, -1, 0.5, 0.4, -1.2, 0.8).finished());
  return {A, A * SE3d::Exp(xi)};
}

// r(d) = Log(A^-1 B Exp(d)); dr/dd at 0 is J_r^-1(r).
TEST(SE3Jet, RelativePoseResidual) {
  const double h = 1e-5;
  for (const auto& xi : Twists()) {
    const Pair pair = MakePair(xi);
    const auto residual = (pair.A.inverse().cast<Jet>() * pair.B.cast<Jet>() *
                           SE3<Jet>::Exp(Variables(Tangent::Zero())))
                              .Log();
    const auto jets = SplitJets(residual);
    const SE3d relative = pair.A.inverse() * pair.B;
    const Tangent r = jets.value;  // at pi the two scalar types may pick either logarithm
    EXPECT_TRUE(Near(LogNear(relative, r), r, 2e-14 * (1 + r.norm()))) << xi.transpose();
    const double scale = 1 + r.norm();
    EXPECT_TRUE(Near(jets.jacobian, SE3d::RightJacobianInverse(r), 2e-13 * scale))
        << xi.transpose();

    Matrix6d differences;
    for (int i = 0; i < 6; ++i) {
      const Tangent d = h * Tangent::Unit(i);
      differences.col(i) =
          (LogNear(relative * SE3d::Exp(d), r) - LogNear(relative * SE3d::Exp(-d), r)) / (2 * h);
    }
    EXPECT_TRUE(Near(jets.jacobian, differences, 2e-8 * scale)) << xi.transpose();
  }
}

TEST(SE3Jet, ExactAtTheIdentity) {
  const auto log = SplitJets(SE3<Jet>::Exp(Variables(Tangent::Zero())).Log());
  EXPECT_TRUE(Near(log.value, Tangent::Zero(), 0.0));
  EXPECT_TRUE(Near(log.jacobian, Matrix6d::Identity(), 0.0));
}

// Exp(xi + d) = Exp(xi) Exp(J_r d): the derivative of Log(Exp(xi)^-1 Exp(xi + d)) is J_r.
TEST(SE3Jet, ExpGivesTheRightJacobian) {
  for (const auto& xi : Twists()) {
    const SE3<Jet> T = SE3<Jet>::Exp(Variables(xi));
    const auto jets = SplitJets((SE3d::Exp(xi).inverse().cast<Jet>() * T).Log());
    EXPECT_TRUE(Near(jets.jacobian, SE3d::RightJacobian(xi), 5e-14 * (1 + xi.norm())))
        << xi.transpose();
  }
}

// Log(Exp(x)) = x below pi, so its derivative is the identity: no reference needed.
TEST(SE3Jet, LogOfExpHasUnitDerivative) {
  for (const auto& xi : Twists(kPi - 1e-9)) {
    const auto jets = SplitJets(SE3<Jet>::Exp(Variables(xi)).Log());
    EXPECT_TRUE(Near(jets.jacobian, Matrix6d::Identity(), 2e-13 * (1 + xi.norm())))
        << xi.transpose();
  }
}

// A Jet's derivative of J_r^-1, against differences: second derivatives, as covariance
// propagation through a residual would use them.
TEST(SE3Jet, JacobianInverseIsDifferentiable) {
  const double h = 1e-5;
  const Tangent u = (Tangent() << 1, -2, 0.5, 0.3, 1, -1).finished();
  for (const auto& xi : Thin(Twists(), 3)) {
    const auto jets = SplitJets(SE3<Jet>::RightJacobianInverse(Variables(xi)) * u.cast<Jet>());
    Matrix6d differences;
    for (int i = 0; i < 6; ++i) {
      const Tangent d = h * Tangent::Unit(i);
      differences.col(i) =
          (SE3d::RightJacobianInverse(xi + d) - SE3d::RightJacobianInverse(xi - d)) * u / (2 * h);
    }
    EXPECT_TRUE(Near(jets.jacobian, differences, 1e-8 * (1 + xi.norm()))) << xi.transpose();
  }
}

// Derivatives by the 7 stored scalars, then by the right perturbation: as Ceres does it
// with a manifold. Covers both covers of the rotation.
TEST(SE3Jet, AmbientDerivativesChain) {
  using Jet7 = ceres::Jet<double, 7>;
  for (const auto& xi : Twists()) {
    for (double sign : {1.0, -1.0}) {
      SE3d T = SE3d::Exp(xi);
      for (int i = 0; i < 4; ++i) T.data()[i] *= sign;
      SE3<Jet7> T7;
      for (int i = 0; i < 7; ++i) T7.data()[i] = Jet7(T.data()[i], i);
      const auto r = T7.Log();
      const SE3<Jet> moved = T.cast<Jet>() * SE3<Jet>::Exp(Variables(Tangent::Zero()));
      Matrix6d chained = Matrix6d::Zero();
      for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < 7; ++k) chained.row(i) += r[i].v[k] * moved.data()[k].v.transpose();
      }
      const Matrix6d expected = SE3d::RightJacobianInverse(T.Log());
      EXPECT_TRUE(Near(chained, expected, 2e-13 * (1 + xi.norm()))) << xi.transpose();
    }
  }
}

TEST(SE3Jet, PointAndMatrixRoundTrip) {
  const Vector3d p(0.3, -2, 5);
  for (const auto& xi : Twists()) {
    const SE3d T = SE3d::Exp(xi);
    const SE3<Jet> moved = T.cast<Jet>() * SE3<Jet>::Exp(Variables(Tangent::Zero()));
    Eigen::Matrix<double, 3, 6> expected;  // d(T Exp(d) p)/dd = [R, -R p^]
    expected << T.so3().matrix(), -T.so3().matrix() * SO3d::hat(p);
    EXPECT_TRUE(Near(SplitJets(moved * p).jacobian, expected, 2e-14));
    EXPECT_TRUE(
        Near(SplitJets(SE3<Jet>::FromMatrix(moved.matrix()) * p).jacobian, expected, 5e-14));
  }
}

}  // namespace
}  // namespace lie::test
