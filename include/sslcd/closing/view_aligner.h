// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd {

/// Two frames, named by their numbers (Frame::index), and where the second one's camera is thought
/// to stand in the first one's frame: odometry or closed loops make that right to some decimetres.
struct ViewPair {
  int a_frame = 0, b_frame = 0;
  Pose T_a_b_guess;
};

/// Measures T_a_b of each pair from the images of its frames (AlignGround is one that does; a host
/// may bring its own). One answer for each pair, in their order. None: the images do not tell; an
/// answer that is not finite, or whose covariance is singular, is none, too. Called by
/// Mapper::Refine, on its thread, with all pairs at once (one every 2 m of path that is seen again;
/// never none), so that they can be aligned in parallel. To stop early, answer none for the rest;
/// what it throws, Refine throws.
using ViewAligner =
    std::function<std::vector<std::optional<RelativePose>>(const std::vector<ViewPair>&)>;

/// Aligns one pair after the other by `align(ViewPair)`, which returns std::optional<RelativePose>
/// and can be copied.
template <class Align>
ViewAligner OneByOne(Align align) {
  return [align = std::move(align)](const std::vector<ViewPair>& pairs) mutable {
    std::vector<std::optional<RelativePose>> answers;
    for (const ViewPair& pair : pairs) answers.push_back(align(pair));
    return answers;
  };
}

}  // namespace sslcd
