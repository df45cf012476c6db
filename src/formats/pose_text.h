// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/pose.h"

namespace sslcd {

/// "x y z qx qy qz qw" with qw >= 0: single blanks, nine decimals.
std::string PoseText(const Pose& T);

}  // namespace sslcd
