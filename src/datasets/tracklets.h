// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/detection.h"

namespace sslcd {

/// One object of a KITTI raw drive, labelled by hand over consecutive frames.
struct Tracklet {
  std::string label;
  Vec3 dims{0, 0, 0};  ///< length, width, height [m]
  int first_frame = 0;
  /// of the cuboid's centre, for frames first_frame, first_frame + 1, ...
  std::vector<Pose> T_velo_object;
};

/// Reads tracklet_labels.xml. The file gives the bottom centre and a turn about z; roll and pitch
/// are not used (KITTI leaves them zero). Throws Error with file:line when it is no such file, cut
/// off, or holds sizes or poses that are not finite and positive.
std::vector<Tracklet> ReadTracklets(const std::string& path);

/// The tracklets as detections of score 1, by frame; rows are numbered in frame order, within a
/// frame in file order.
std::map<int, std::vector<Detection>> TrackletDetections(const std::vector<Tracklet>& tracklets,
                                                         const Pose& T_cam_velo);

}  // namespace sslcd
