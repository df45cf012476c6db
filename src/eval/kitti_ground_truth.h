// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// One annotated ground-truth box of KITTI tracking, for evaluation only.
struct GroundTruthBox {
  int frame = 0;
  int track = -1;  ///< identity, the same in all frames
  std::string label;
  Pose T_cam_object;   ///< at the box's centre, axes as in Detection
  Vec3 dims{0, 0, 0};  ///< length, width, height [m]
};

/// Reads label_02/NNNN.txt: 17 columns `frame track label truncated occluded alpha left top right
/// bottom h w l x y z ry`, with x y z the centre of the bottom face; an 18th column (a score) is
/// allowed. DontCare rows are left out, all other rows are returned in the file's order. Throws
/// Error (kBadInput) with file and line.
std::vector<GroundTruthBox> ReadKittiTrackingLabels(const std::string& path);

/// Reads landmark_ids.txt of a sequence folder: the true identity of each detection row, one
/// integer a line; negative: a false alarm. Throws Error (kBadInput) with file and line.
std::vector<int> ReadLandmarkIds(const std::string& path);

}  // namespace sslcd
