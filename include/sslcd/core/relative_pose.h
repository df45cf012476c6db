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

}  // namespace sslcd
