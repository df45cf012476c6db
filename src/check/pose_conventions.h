// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "check/outcome.h"

namespace sslcd::check {

/// A way to write poses other than T_world_cam with x right, y down, z forward, and how to read it.
struct PoseConvention {
  std::string id;    ///< of the mistake
  std::string name;  ///< completes "with ..."
  std::function<Pose(const Pose&)> correct;
};

/// The likeliest come first: several explain the same straight path.
const std::vector<PoseConvention>& PoseConventions();

/// The mean cosine between the camera's motion and its z axis. None: fewer than 15 steps in which
/// the camera moves.
std::optional<double> ForwardShare(const Sequence& sequence,
                                   const std::function<Pose(const Pose&)>& correct);

/// Whether static objects agree with the poses, or with those of another convention.
Outcome CheckPoseConvention(const Sequence& sequence);

}  // namespace sslcd::check
