// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "closing/loop_ledger.h"
#include "core/frame_store.h"

namespace sslcd {

/// What loops say about the heights of an odometry that keeps level, e.g. by an inertial sensor.
struct HeightCorrection {
  std::vector<double> rise_m;  ///< to add to the odometry's height of each frame
  double probability = 0;      ///< that this is nearer to the truth; see ImprovementProbability
};

/// The heights of level odometry err as a random walk along the path (RandomWalk), which loops
/// and aligned views measure. Objects in sight do not count: on a slope their heights change with
/// their range, which over kilometres bends a path by metres that the odometry has right. `frames`
/// has the odometry as given, and the poses that turn the loops' measurements upright.
HeightCorrection HeightsByLoops(const FrameStore& frames, const LoopLedger& loops,
                                const std::vector<ViewTie>& ties, const Vec3& up);

}  // namespace sslcd
