// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// Strong type of landmark ids. Ids are never reused; a fused landmark keeps one of its two ids.
struct LandmarkId {
  int value = -1;
  friend bool operator==(LandmarkId a, LandmarkId b) { return a.value == b.value; }
  friend bool operator!=(LandmarkId a, LandmarkId b) { return a.value != b.value; }
  friend bool operator<(LandmarkId a, LandmarkId b) { return a.value < b.value; }
};

/// The state of a landmark.
enum class LandmarkState {
  kTentative,  ///< not confirmed yet
  kConfirmed,  ///< part of the map
  kDynamic,    ///< moving: tracked, but not part of the map
  kStale,      ///< tentative, not seen again and dropped
};

/// "tentative", "confirmed", "dynamic", "stale".
const char* ToString(LandmarkState state);

/// Landmark `o_k` was matched with row `detection_row` of the detections in frame `frame`.
struct Observation {
  int frame = 0;          ///< frame number in the dataset
  int detection_row = 0;  ///< Detection::row
};

/// One object of the map in map.json. The object frame is upright: roll and pitch relative to the
/// map's up axis are zero.
struct MapObject {
  LandmarkId id;
  std::string label;
  LandmarkState state = LandmarkState::kTentative;
  Pose T_world_object;  ///< at the cuboid's centre: x along its length, y to its left, z up
  Vec3 dims{0, 0, 0};   ///< length, width, height [m]
  std::vector<Observation> observations;
  Eigen::Matrix<double, 4, 4, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 4, 4,
                    Eigen::DontAlign>::Zero();  ///< of [x y z yaw], world axes; zero: not computed
};

}  // namespace sslcd
