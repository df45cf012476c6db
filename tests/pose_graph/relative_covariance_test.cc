// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/relative_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <random>

namespace sslcd {
namespace {

using Mat6 = RelativeCovariances::Mat6;

// A covariance with correlations, the same for the same seed.
Mat6 Correlated(unsigned seed) {
  std::mt19937 random(seed);
  Mat6 root;
  for (double& entry : root.reshaped()) entry = static_cast<double>(random() % 2001) * 1e-3 - 1;
  return root * root.transpose() + 0.1 * Mat6::Identity();
}

void ExpectEqual(const Mat6& a, const Mat6& b) {
  EXPECT_TRUE(a.isApprox(b, 1e-9)) << a << "\n\n" << b;
}

// By the pseudo-inverse of the whole information matrix, in which no unknown is fixed.
Mat6 ByPseudoInverse(int unknowns, const std::vector<DifferenceMeasurement>& measurements, int a,
                     int b) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(6 * unknowns, 6 * unknowns);
  for (const DifferenceMeasurement& each : measurements) {
    Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(6, 6 * unknowns);
    difference.middleCols<6>(6 * each.from) = -Mat6::Identity();
    difference.middleCols<6>(6 * each.to) = Mat6::Identity();
    information += difference.transpose() * each.covariance.inverse() * difference;
  }
  const Eigen::MatrixXd inverse = information.completeOrthogonalDecomposition().pseudoInverse();
  const auto block = [&](int i, int j) -> Mat6 { return inverse.block<6, 6>(6 * i, 6 * j); };
  return block(a, a) + block(b, b) - block(a, b) - block(b, a);
}

// Two ways from 0 to 3, with a bridge between their middles.
std::vector<DifferenceMeasurement> Wheatstone() {
  return {{0, 1, Correlated(1)},
          {1, 3, Correlated(2)},
          {0, 2, Correlated(3)},
          {3, 2, Correlated(4)},
          {2, 1, Correlated(5)}};
}

TEST(RelativeCovariances, InSeriesCovariancesAddUp) {
  const Mat6 a = Correlated(1), b = Correlated(2), c = Correlated(3);
  const RelativeCovariances chain(4, {{0, 1, a}, {1, 2, b}, {2, 3, c}});
  ExpectEqual(chain.Between(0, 1), a);
  ExpectEqual(chain.Between(0, 3), a + b + c);
  ExpectEqual(chain.Between(1, 3), b + c);
}

TEST(RelativeCovariances, InParallelInformationAddsUp) {
  const Mat6 a = Correlated(1), b = Correlated(2), c = Correlated(3);
  const Mat6 expected = (Mat6(a + b).inverse() + c.inverse()).inverse();
  const RelativeCovariances ring(3, {{0, 1, a}, {1, 2, b}, {0, 2, c}});
  ExpectEqual(ring.Between(0, 2), expected);
  const RelativeCovariances twice(2, {{0, 1, a}, {1, 0, a}});
  ExpectEqual(twice.Between(0, 1), 0.5 * a);
}

TEST(RelativeCovariances, OfABridgeAreThoseOfThePseudoInverse) {
  const RelativeCovariances bridge(4, Wheatstone());
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      if (a != b) ExpectEqual(bridge.Between(a, b), ByPseudoInverse(4, Wheatstone(), a, b));
}

TEST(RelativeCovariances, AreTheSameBothWaysAndZeroForOneUnknown) {
  const RelativeCovariances bridge(4, Wheatstone());
  for (int a = 0; a < 4; ++a) {
    EXPECT_EQ(bridge.Between(a, a), Mat6::Zero());
    for (int b = 0; b < a; ++b) ExpectEqual(bridge.Between(a, b), bridge.Between(b, a));
  }
}

TEST(RelativeCovariances, VarianceIsThatOfTheCovariance) {
  const RelativeCovariances bridge(4, Wheatstone());
  const RelativeCovariances::Vec6 w(0.3, -1, 2, 0.5, 0.1, -0.7);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      EXPECT_NEAR(bridge.Variance(a, b, w), w.dot(bridge.Between(a, b) * w), 1e-9) << a << " " << b;
}

TEST(RelativeCovariances, OneMoreMeasurementNeverWidensThem) {
  std::vector<DifferenceMeasurement> more = Wheatstone();
  more.push_back({0, 3, 5 * Correlated(6)});
  const RelativeCovariances with(4, more), without(4, Wheatstone());
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < a; ++b) {
      const Mat6 gain = without.Between(a, b) - with.Between(a, b);
      EXPECT_GT(gain.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12);
    }
}

TEST(RelativeCovariances, OfASingleUnknown) {
  EXPECT_EQ(RelativeCovariances(1, {}).Between(0, 0), Mat6::Zero());
}

}  // namespace
}  // namespace sslcd
