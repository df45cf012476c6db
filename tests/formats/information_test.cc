// SPDX-License-Identifier: BSD-3-Clause
#include "formats/information.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <cmath>
#include <limits>
#include <random>

namespace sslcd {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A symmetric matrix with the given eigenvalues and random eigenvectors.
MatrixXd WithEigenvalues(const VectorXd& values, unsigned seed) {
  std::mt19937 engine(seed);
  MatrixXd random(values.size(), values.size());
  for (double& x : random.reshaped()) x = (engine() + 0.5) / 4294967296. - 0.5;
  const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(random).householderQ();
  return Q * values.asDiagonal() * Q.transpose();
}

TEST(ProjectInformation, RaisesSmallEigenvaluesOnly) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const VectorXd values = (VectorXd(6) << -30, -1e-7, 0, 0.5, 20, 400).finished();
    const MatrixXd given = WithEigenvalues(values, seed);
    const auto projected = ProjectInformation(given);
    ASSERT_TRUE(projected);
    const double floor = kInformationFloor * 400;
    const MatrixXd expected = WithEigenvalues(values.cwiseMax(floor), seed);
    EXPECT_LT((projected->information - expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(projected->least_eigenvalue, -30. / 400, 1e-14);
    EXPECT_EQ(projected->information, projected->information.transpose());
    EXPECT_EQ(MatrixXd(projected->information).llt().info(), Eigen::Success);
    // The distance to the nearest matrix is the norm of what was clamped.
    EXPECT_NEAR((projected->information - given).norm(), (values.cwiseMax(floor) - values).norm(),
                1e-12);
  }
}

TEST(ProjectInformation, KeepsPositiveDefiniteMatrices) {
  const MatrixXd given = WithEigenvalues((VectorXd(6) << 1e-3, 1, 2, 5, 20, 400).finished(), 3);
  const auto projected = ProjectInformation(given);
  ASSERT_TRUE(projected);
  EXPECT_LT((projected->information - given).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(projected->least_eigenvalue, 1e-3 / 400, 1e-16);
}

TEST(ProjectInformation, IsItsOwnResult) {
  const MatrixXd given = WithEigenvalues((VectorXd(3) << -2, 1, 3).finished(), 1);
  const MatrixXd once = ProjectInformation(given)->information;
  EXPECT_LT((ProjectInformation(once)->information - once).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(ProjectInformation, ScalesWithTheUnit) {
  const MatrixXd given = WithEigenvalues((VectorXd(6) << -2, 0, 1, 3, 5, 7).finished(), 1);
  const MatrixXd expected = ProjectInformation(given)->information;
  for (const double unit : {1e-290, 1e-6, 1e6, 1e290}) {
    const auto projected = ProjectInformation(unit * given);
    ASSERT_TRUE(projected) << unit;
    EXPECT_LT((projected->information / unit - expected).cwiseAbs().maxCoeff(), 1e-13) << unit;
  }
}

TEST(ProjectInformation, AveragesTheTriangles) {
  MatrixXd given = WithEigenvalues((VectorXd(6) << 0, 1, 2, 3, 4, 5).finished(), 1);
  const MatrixXd symmetric = ProjectInformation(given)->information;
  given(0, 4) += 1e-9;
  given(4, 0) -= 1e-9;
  EXPECT_LT((ProjectInformation(given)->information - symmetric).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(ProjectInformation, RefusesMatricesWithoutInformation) {
  EXPECT_FALSE(ProjectInformation(MatrixXd::Zero(6, 6)));
  EXPECT_FALSE(ProjectInformation(-MatrixXd::Identity(3, 3)));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    MatrixXd given = MatrixXd::Identity(6, 6);
    given(2, 3) = given(3, 2) = bad;
    EXPECT_FALSE(ProjectInformation(given));
  }
}

}  // namespace
}  // namespace sslcd
