// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"

namespace sslcd {

/// Reads 2D boxes of a sequence, one a row: `frame label score left top right bottom [px]`. Frames
/// may come in any order; those without boxes are not listed; the order of a frame's boxes is the
/// file's. Throws Error with file:line for a row of another number of columns, a letter in a
/// number, a negative frame, a number that is not finite, a score outside [0, 1], and a box without
/// area.
std::map<int, std::vector<ImageDetection>> ReadBoxes(const std::string& path);

}  // namespace sslcd
