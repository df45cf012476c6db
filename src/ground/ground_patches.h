// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "ground/top_view.h"
#include "sslcd/ground/ground_alignment.h"

/// Two top views of the same ground. T_a_b is between their ground frames (LevelOn): a shift in x
/// and z, and a heading about y.
namespace sslcd {

/// An image and the pose of its camera over the ground.
struct GroundView {
  cv::Mat grey;
  Pose T_cam_ground;
};

/// Projects a pose between two ground frames to shift and heading.
Pose OnGround(const Pose& T);

/// The area to compare in the first view's ground frame, in cells of `cell` metres.
GroundGrid GridOf(double cell);

/// Finds the motion T_a_b near `guess` with the best total correlation of all patches, to one cell.
/// Uses a coarse view. `search_m` is the largest error of the guess in each direction.
std::optional<Pose> FindMotion(const GroundView& a, const GroundView& b, const StereoCamera& camera,
                               const Pose& guess, double search_m);

/// A point on the ground in the first view and its correspondence in the second one. [m]
struct GroundPair {
  Vec3 in_a, in_b;
};

/// Finds patches of the first view in the second one, up to `search` cells away, to a fraction of a
/// cell. `tried` is the number of patches that both views show.
std::vector<GroundPair> MatchPatches(const TopView& from, const TopView& to, const GroundGrid& grid,
                                     int search, int& tried);

/// Estimates the motion from in_b to in_a by least squares with Geman and McClure's weights. Keeps
/// the inliers.
Pose FitMotion(std::vector<GroundPair>& pairs);

}  // namespace sslcd
