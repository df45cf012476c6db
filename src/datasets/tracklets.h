// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/detection.h"

namespace sslcd {

/// One hand-labelled object of a KITTI raw drive over consecutive frames.
struct Tracklet {
  std::string label;
  Vec3 dims{0, 0, 0};  ///< length, width, height [m]
  int first_frame = 0;
  /// poses of the cuboid's centre in frames first_frame, first_frame + 1, ...
  std::vector<Pose> T_velo_object;
};

/// Reads tracklet_labels.xml. The file gives the bottom centre and a rotation about z; roll and
/// pitch are not used (KITTI leaves them zero). Throws Error with file:line if the file has another
/// format, is truncated, or contains poses that are not finite or sizes that are not positive.
std::vector<Tracklet> ReadTracklets(const std::string& path);

/// Converts tracklets to detections of score 1 by frame. Rows are numbered in frame order and,
/// within a frame, in file order.
std::map<int, std::vector<Detection>> TrackletDetections(const std::vector<Tracklet>& tracklets,
                                                         const Pose& T_cam_velo);

}  // namespace sslcd
