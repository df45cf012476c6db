// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sslcd/closing/view_aligner.h"
#include "sslcd/core/detection.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// The content of an input of kind "frame" (docs/store.md): all of a frame but its image paths.
std::string FrameBytes(const Frame& frame);
Frame FrameOf(std::string_view bytes);

/// A pair of frames and its answer by a ViewAligner; numbers of the map.
struct AlignedView {
  int a_frame = 0, b_frame = 0;
  std::optional<RelativePose> T_a_b;
};

/// A call of Mapper::Refine, and what the ViewAligner has answered: its images need not be there
/// when the map is made again.
struct RefinementInput {
  Refinement when = Refinement::kAtEnd;
  std::vector<AlignedView> views;
};
std::string RefinementBytes(const RefinementInput& refinement);
RefinementInput RefinementOf(std::string_view bytes);

}  // namespace sslcd
