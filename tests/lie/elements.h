// SPDX-License-Identifier: BSD-3-Clause
// Group elements and comparisons for the property tests.
#pragma once

#include <gtest/gtest.h>
#include <lie/se3.h>

#include <cmath>
#include <random>
#include <vector>

namespace lie::test {

inline constexpr double kPi = 3.141592653589793238462643383279502884;

/// |a - b| <= tol in the Frobenius norm; false for NaN.
template <class A, class B>
::testing::AssertionResult Near(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b,
                                double tol) {
  const double distance = (a - b).norm();
  if (!(distance <= tol)) {
    return ::testing::AssertionFailure() << "distance " << distance << " > " << tol << "\n"
                                         << a << "\nand\n"
                                         << b << "\n";
  }
  return ::testing::AssertionSuccess();
}

/// The same rotation: q and -q are one.
inline ::testing::AssertionResult Near(const SO3d& a, const SO3d& b, double tol) {
  const double sign = a.unit_quaternion().dot(b.unit_quaternion()) < 0 ? -1.0 : 1.0;
  return Near(a.unit_quaternion().coeffs(), sign * b.unit_quaternion().coeffs(), tol);
}

inline ::testing::AssertionResult Near(const SE3d& a, const SE3d& b, double tol) {
  const auto rotation = Near(a.so3(), b.so3(), tol);
  return rotation ? Near(a.translation(), b.translation(), tol) : rotation;
}

/// Rotation angles: zero, near zero, both sides of every branch, near pi, pi.
inline std::vector<double> Angles() {
  return {0.0,
          1e-200,
          1e-12,
          1e-8,
          1e-5,
          1e-3,
          0.1,
          2 * std::atan(0.2) - 1e-9,
          2 * std::atan(0.2) + 1e-9,
          0.7,
          std::sqrt(2.0) - 1e-9,
          std::sqrt(2.0) + 1e-9,
          kPi / 2,
          2.5,
          std::sqrt(8.0) + 1e-9,
          kPi - 1e-3,
          kPi - 1e-8,
          kPi};
}

inline std::vector<Eigen::Vector3d> Axes() {
  std::vector<Eigen::Vector3d> axes = {Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(),
                                       Eigen::Vector3d::UnitZ(), {0.6, 0.0, -0.8},
                                       {1e-9, 1.0, 0.0},         {1.0, -2.0, 3.0},
                                       {-0.3, -0.2, -0.1}};
  for (auto& a : axes) a.normalize();
  return axes;
}

/// Rotation vectors with |phi| <= max_angle (pi included where it allows).
inline std::vector<Eigen::Vector3d> RotationVectors(double max_angle = kPi) {
  std::vector<Eigen::Vector3d> all;
  for (double angle : Angles()) {
    if (angle > max_angle) continue;
    for (const auto& axis : Axes()) all.push_back(angle * axis);
  }
  std::mt19937 rng(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d phi(normal(rng), normal(rng), normal(rng));
    if (phi.norm() <= max_angle) all.push_back(phi);
  }
  return all;
}

/// Twists [rho, phi]: each rotation vector with a translation part from zero to metres.
inline std::vector<SE3d::Tangent> Twists(double max_angle = kPi) {
  const Eigen::Vector3d rhos[] = {{0, 0, 0}, {1e-9, 0, -1e-7}, {0.3, -0.1, 0.2}, {-4, 7, 1}};
  std::vector<SE3d::Tangent> all;
  for (const auto& phi : RotationVectors(max_angle)) {
    for (const auto& rho : rhos) all.push_back((SE3d::Tangent() << rho, phi).finished());
  }
  return all;
}

/// Every n-th element, for tests over pairs and triples.
template <class V>
std::vector<V> Thin(const std::vector<V>& all, size_t n) {
  std::vector<V> some;
  for (size_t i = 0; i < all.size(); i += n) some.push_back(all[i]);
  return some;
}

/// Log of a group element that lies near `reference`: undoes the jump of Log at pi.
inline Eigen::Vector3d LogNear(const SO3d& R, const Eigen::Vector3d& reference) {
  const Eigen::Vector3d phi = R.Log();
  const double angle = phi.norm();
  if (angle == 0.0) return phi;
  const Eigen::Vector3d other = phi * (1.0 - 2.0 * kPi / angle);
  return (other - reference).norm() < (phi - reference).norm() ? other : phi;
}

inline SE3d::Tangent LogNear(const SE3d& T, const SE3d::Tangent& reference) {
  const Eigen::Vector3d phi = LogNear(T.so3(), Eigen::Vector3d(reference.tail<3>()));
  SE3d::Tangent xi;
  xi.head<3>() = SO3d::LeftJacobianInverse(phi) * T.translation();
  xi.tail<3>() = phi;
  return xi;
}

}  // namespace lie::test
