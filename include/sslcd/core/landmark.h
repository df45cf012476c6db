// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Strong type for landmark ids: never reused, survives fusion.
struct LandmarkId {
  int value = -1;
  friend bool operator==(LandmarkId a, LandmarkId b) { return a.value == b.value; }
  friend bool operator!=(LandmarkId a, LandmarkId b) { return a.value != b.value; }
  friend bool operator<(LandmarkId a, LandmarkId b) { return a.value < b.value; }
};

/// Life cycle of a landmark.
enum class LandmarkState {
  kTentative,  ///< seen, not yet confirmed
  kConfirmed,  ///< part of the map
  kDynamic,    ///< moves in the world: tracked, never part of the map
  kStale,      ///< tentative and not seen again: given up
};

/// "tentative", "confirmed", "dynamic", "stale".
const char* ToString(LandmarkState state);

/// Landmark `o_k` was matched with row `detection_row` of the detections in frame `frame`.
struct Observation {
  int frame = 0;
  int detection_row = 0;
};

/// One object of the finished map, as it is written to map.json. The object frame is upright: roll
/// and pitch are zero with respect to the map's up axis.
struct MapObject {
  LandmarkId id;
  std::string label;
  LandmarkState state = LandmarkState::kTentative;
  Pose T_world_object;
  Vec3 dims{0, 0, 0};  ///< length, width, height [m]
  std::vector<Observation> observations;
  Eigen::Matrix<double, 4, 4, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 4, 4,
                    Eigen::DontAlign>::Zero();  ///< of [x y z yaw], world axes; zero: not computed
};

}  // namespace sslcd
