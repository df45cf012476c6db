// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/pose.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

TEST(RelativePose, ComposeCarriesErrorsAlong) {
  const Pose T_a_b = Pose::Trans(3, -1, 0.5) * Pose::RotY(2.),
             T_b_c = Pose::Trans(0.2, 0.1, 14) * Pose::RotX(0.3);
  Vec6 variances;
  variances << 1e-4, 4e-4, 9e-4, 1e-6, 4e-6, 2e-6;
  const RelativePose ab{T_a_b, variances.asDiagonal()},
      bc{T_b_c, 2 * Pose::Matrix6(variances.asDiagonal())};
  const RelativePose ac = Compose(ab, bc);
  EXPECT_LT((ac.T_a_b.inverse() * (T_a_b * T_b_c)).Log().norm(), 1e-12);
  // One component of one error at a time, by differences.
  Pose::Matrix6 expected = Pose::Matrix6::Zero();
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    Vec6 d = Vec6::Zero();
    d[i] = kStep;
    const Vec6 of_ab = (ac.T_a_b.inverse() * (T_a_b * Pose::Exp(d) * T_b_c)).Log() / kStep;
    const Vec6 of_bc = (ac.T_a_b.inverse() * (T_a_b * T_b_c * Pose::Exp(d))).Log() / kStep;
    expected += variances[i] * (of_ab * of_ab.transpose() + 2 * of_bc * of_bc.transpose());
  }
  EXPECT_LT((ac.covariance - expected).norm(), 1e-4 * expected.norm());
}

TEST(Agrees, WithinTheConfidenceRegion) {
  RelativePose measured;
  measured.T_a_b = Pose::Trans(4, 0, 2) * Pose::RotY(0.3);
  measured.covariance = 0.01 * Pose::Matrix6::Identity();
  // chi2 of one component: (x / .1)^2; the limit for six degrees and .9 is 10.64
  const auto off = [&](double x) {
    return Agrees(measured, measured.T_a_b * Pose::Trans(x, 0, 0), 0.9);
  };
  EXPECT_TRUE(off(0));
  EXPECT_TRUE(off(0.32));
  EXPECT_FALSE(off(0.33));
  EXPECT_FALSE(Agrees(measured, measured.T_a_b * Pose::Trans(NAN, 0, 0), 0.9));
}

}  // namespace
}  // namespace sslcd
