// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "ground/top_view.h"
#include "sslcd/ground/ground_alignment.h"

/// Two views of one ground, laid over each other. T_a_b is between their ground frames (LevelOn)
/// here: a shift in x and z, and a heading about y.
namespace sslcd {

/// An image, and where its camera stands above its own ground.
struct GroundView {
  cv::Mat grey;
  Pose T_cam_ground;
};

/// Of a pose between two ground frames, what a camera can do that stays on the ground: shift and
/// heading.
Pose OnGround(const Pose& T);

/// The ground that is compared, in the first view's ground frame, in cells of `cell` metres.
GroundGrid GridOf(double cell);

/// The motion T_a_b, near `guess`, at which all patches together fit best: to a cell. A coarse
/// view: what is looked for is large. `search_m`: how far off the guess may be in each direction.
std::optional<Pose> FindMotion(const GroundView& a, const GroundView& b, const StereoCamera& camera,
                               const Pose& guess, double search_m);

/// A place on the ground as the first view has it, and where the second one shows the same. [m]
struct GroundPair {
  Vec3 in_a, in_b;
};

/// Patches of the first view that are found in the second one, up to `search` cells away, to a
/// fraction of a cell. `tried`: how many both views show.
std::vector<GroundPair> MatchPatches(const TopView& from, const TopView& to, const GroundGrid& grid,
                                     int search, int& tried);

/// The motion that takes in_b to in_a: least squares with Geman and McClure's weights. Keeps the
/// pairs that agree.
Pose FitMotion(std::vector<GroundPair>& pairs);

}  // namespace sslcd
