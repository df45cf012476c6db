// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "sslcd/core/relative_pose.h"

namespace sslcd {

/// Measures from the images of two frames where the second one's camera stands in the first one's frame, given a
/// guess that odometry or closed loops make right to some decimetres (AlignGround is such a one; a host may bring its
/// own).
/// None: the images do not tell; an answer that is not finite, or whose covariance is singular, is none, too. Both
/// frames are named by their numbers (Frame::index). Called by Mapper::Refine, in order of the frames; what it throws
/// ends that.
using ViewAligner = std::function<std::optional<RelativePose>(int a_frame, int b_frame, const Pose& T_a_b_guess)>;

}  // namespace sslcd
