// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "closing/pass_layout.h"
#include "closing/pass_map.h"
#include "loop/drift.h"
#include "loop/layout_index.h"
#include "odometry/odometry_noise.h"
#include "sslcd/closing/options.h"
#include "sslcd/core/loop_closure.h"

namespace sslcd {

/// A loop measured from matched objects.
struct LoopMeasurement {
  LoopClosure row;
  int query = 0, match = 0;  ///< indices of the two frames
  /// standard deviation of the heading of T_match_query from its matches [rad]
  double heading_sigma = 0;
};

/// Objects of the local map that older passes have also seen.
struct CommonObjects {
  const PassLayout& local;
  std::vector<std::pair<int, LandmarkId>> pairs;  ///< local index and old landmark
  double sigma_m;                                 ///< standard deviation of their positions
  double global_end_m;                            ///< path length at the end of the older passes
};

/// Converts matches of indices to pairs of local index and old landmark.
std::vector<std::pair<int, LandmarkId>> OldLandmarks(
    const std::vector<std::pair<int, int>>& matches, const LayoutIndex& global);

/// Turns matched layouts into the relative pose of two cameras (paper IV-D, Eqs. 17 and 18).
/// The paper moves the newest camera by the drift of all matched objects. But odometry errors
/// deform both maps, so the drift is valid in their centre and not at their ends. Therefore the
/// query camera is one near its matched objects, the match camera is the old one nearest to its
/// corrected pose, and objects seen at a large path distance from the two have less weight. Both
/// maps are aligned with gravity first, since the ground at one place has one slope.
class LoopMeter {
 public:
  /// Keeps references to `state`, `passes`, `options` and the local map; `factors` are on
  /// `options.odometry`.
  LoopMeter(const CommonObjects& common, const MapState& state, const PassMap& passes,
            const LoopOptions& options, const OdometryFactors& factors = {});

  /// Tries the camera at `query_m` of path and, while the heading is too uncertain, earlier
  /// cameras. Excludes cameras more than `beyond_m` before the first common object or after the
  /// last one. The covariance includes the odometry noise of that path. None: the objects do not
  /// determine a pose.
  std::optional<LoopMeasurement> Measure(double query_m, double beyond_m);

  /// Measures the loop between two frames, given by index.
  std::optional<LoopMeasurement> MeasureBetween(int query, int match) const;

 private:
  DriftPair PairOf(int local, LandmarkId old, const MapState& state) const;
  int NearestOldFrame(const Pose& T_world_cam) const;
  Pose LevelFrame(int frame) const;

  const CommonObjects common_;
  const FrameStore& frames_;
  const GravityFrame& gravity_;
  const PassMap& passes_;
  const LoopOptions& options_;
  OdometryFactors factors_;
  std::vector<DriftPair> pairs_;      // of the common objects, in their order
  double first_m_, last_m_;           // path lengths of the first and the last of them
  std::optional<DriftResult> drift_;  // of all of them, once it was asked for
};

/// Horizontal angle between the viewing directions of two cameras. [rad]
double ViewpointChange(const Pose& T_world_a, const Pose& T_world_b, const GravityFrame& gravity);

}  // namespace sslcd
