// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/label.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/layout.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// A finished map to localise in.
struct ReferenceMap {
  GravityFrame gravity;  ///< of the map's world
  LabelTable labels;
  double scale = 1;  ///< metres per odometry metre of the robot
  /// the landmarks, with all that is known of them; `label` is an index of `label_names`,
  /// `altitude` the height in the map's world
  std::vector<LayoutObject> objects;
  std::vector<std::string> label_names;
};

/// The answer of an attempt to find a camera in a map. kAccepted: it is found. kAmbiguous: objects
/// of the map agree, but not surely enough (`reason`). kNone: there is no candidate. Poses are only
/// set if there is a candidate.
struct Localisation : LoopVerdict {
  int frame = 0;   ///< Frame::index of the camera
  Pose T_map_cam;  ///< pose of the camera in the map's world
  /// corrects the next frames: T_map_cam = T_map_odom T_odom_cam, where the translation of
  /// T_odom_cam is that of the odometry times ReferenceMap::scale
  Pose T_map_odom;
  double probability = 0;   ///< that the pose is right: 1 / (1 + exp(-score))
  double travelled_m = 0;   ///< path since the first frame
  int objects_in_view = 0;  ///< objects of the local map
  /// covariance of the right perturbation T_map_cam Exp(d), d = [translation, rotation]
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Zero();
  /// matched objects: of this drive, and of the map
  std::vector<std::pair<LandmarkId, LandmarkId>> pairs;
};

}  // namespace sslcd
