// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sslcd/core/detection.h"
#include "sslcd/core/pose.h"
#include "sslcd/formats/poses.h"

namespace sslcd {

/// The true poses of `file` with stamps of the frames' clock. Poses without stamps are one per
/// frame, row i of frame i; so are poses with stamps of another clock if there are as many as
/// `frames_in_file` (the frames before a limit on their number). Poses of another clock and
/// another number cannot be paired: none. Each of these is a warning.
std::optional<Trajectory> GroundtruthOfFrames(const PoseFile& file, const std::string& path,
                                              const std::vector<Frame>& frames,
                                              std::size_t frames_in_file,
                                              std::vector<std::string>& warnings);

}  // namespace sslcd
