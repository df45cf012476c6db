// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "closing/pass_map.h"
#include "loop/drift.h"
#include "loop/layout_index.h"
#include "sslcd/closing/options.h"
#include "sslcd/core/loop_closure.h"

namespace sslcd {

/// What a loop closure says, measured from matched objects.
struct LoopMeasurement {
  LoopClosure row;
  int query = 0, match = 0;  ///< the two cameras: indices into the frames
  double heading_sigma = 0;  ///< of T_match_query about the vertical, by its matches [rad]
};

/// Objects of the local map that older passes have seen, too.
struct CommonObjects {
  const PassLayout& local;
  std::vector<std::pair<int, LandmarkId>> pairs;  ///< index of local, the old landmark
  double sigma_m;                                 ///< how well their positions agree
  double old_until_m;                             ///< where the path of the older passes ends
};

/// Matches by their indices -> index of local, old landmark.
std::vector<std::pair<int, LandmarkId>> OldLandmarks(
    const std::vector<std::pair<int, int>>& matches, const LayoutIndex& global);

/// Turns matched layouts into the relative pose of two cameras (paper IV-D, Eqs. 17 and 18).
///
/// The paper moves the newest camera by the drift of all matched objects. Odometry bends both maps,
/// though, so that drift holds in their midst and not at their ends: the query camera is one among
/// its matched objects, or not far from them, the match camera the old one nearest to its corrected
/// pose, and objects seen far from the two along the path count less. Both maps are levelled first:
/// the ground at one place has one slope, whatever odometry says.
class LoopMeter {
 public:
  /// Refers to all three.
  LoopMeter(const MapState& state, const PassMap& passes, const LoopOptions& options)
      : state_(state),
        frames_(state.frames),
        gravity_(state.gravity()),
        passes_(passes),
        options_(options) {}

  /// Tries the camera at `query_m` of path and, while the heading remains too uncertain, cameras
  /// further back; none that stood more than `beyond_m` before the first common object or after the
  /// last one. What odometry may do over that stretch counts in the covariance. None where the
  /// objects fix no pose.
  std::optional<LoopMeasurement> Measure(const CommonObjects& common, double query_m,
                                         double beyond_m) const;

  /// Of two cameras, given by their indices.
  std::optional<LoopMeasurement> MeasureBetween(int query, int match,
                                                const CommonObjects& common) const;

 private:
  std::vector<DriftPair> Pairs(const CommonObjects& common) const;
  int NearestOldFrame(const Pose& T_world_cam, const CommonObjects& common) const;
  double OdometrySigma(int frame, double seen_m) const;
  Pose LevelFrame(int frame) const;

  const MapState& state_;
  const FrameStore& frames_;
  const GravityFrame& gravity_;
  const PassMap& passes_;
  const LoopOptions& options_;
};

/// Horizontal angle between the viewing directions of two cameras. [rad]
double ViewpointChange(const Pose& T_world_a, const Pose& T_world_b, const GravityFrame& gravity);

}  // namespace sslcd
