// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sslcd/core/pose.h"

namespace sslcd {

/// Where one camera stands in another one's frame, as measured.
struct RelativePose {
  Pose T_a_b;
  /// Of the right perturbation T_a_b Exp(d), d = [translation, rotation].
  Pose::Matrix6 covariance = Pose::Matrix6::Identity();
};

/// Two cameras whose relative pose was measured, by the indices of their frames.
struct ViewTie {
  int from = 0, to = 0;
  RelativePose pose;  ///< T_from_to
};

/// T_a_c from T_a_b and T_b_c, whose errors are independent.
inline RelativePose Compose(const RelativePose& ab, const RelativePose& bc) {
  // T_a_b Exp(d) T_b_c = T_a_b T_b_c Exp(Adj(T_b_c^-1) d)
  const Pose::Matrix6 adjoint = bc.T_a_b.inverse().Adj();
  return {ab.T_a_b * bc.T_a_b, adjoint * ab.covariance * adjoint.transpose() + bc.covariance};
}

/// Whether `T_a_b` lies within the measurement's confidence region of that probability.
bool Agrees(const RelativePose& measured, const Pose& T_a_b, double probability);

}  // namespace sslcd
