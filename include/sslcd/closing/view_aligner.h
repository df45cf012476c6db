// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// Two frames by number (Frame::index) and a guess of the second camera's pose in the first one's
/// frame, from odometry or closed loops, with errors of some decimetres.
struct ViewPair {
  int a_frame = 0, b_frame = 0;
  Pose T_a_b_guess;
};

/// Measures T_a_b of each pair from the images of its frames, e.g. by AlignGround. Returns one
/// answer per pair, in their order. None: the pair cannot be aligned; an answer that is not finite
/// or has a singular covariance counts as none. Mapper::Refine calls it on its thread with all
/// pairs at once, so that they can be aligned in parallel: one pair per 2 m of revisited path, at
/// least one. To stop early, return none for the remaining pairs. Refine passes on its exceptions.
using ViewAligner =
    std::function<std::vector<std::optional<RelativePose>>(const std::vector<ViewPair>&)>;

/// Makes a ViewAligner that aligns one pair after the other by `align(ViewPair)`. `align` must be
/// copyable and return std::optional<RelativePose>.
template <class Align>
ViewAligner OneByOne(Align align) {
  return [align = std::move(align)](const std::vector<ViewPair>& pairs) mutable {
    std::vector<std::optional<RelativePose>> answers;
    for (const ViewPair& pair : pairs) answers.push_back(align(pair));
    return answers;
  };
}

}  // namespace sslcd
