// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/export.h"

namespace sslcd {

/// Reads the 2D boxes of a sequence by frame number. A row is `frame label score left top right
/// bottom`, with the box in px. Frames may come in any order. The result keeps the file's order of
/// the boxes of a frame and has no entry for frames without boxes. Throws Error with file:line for
/// a wrong number of columns, a malformed or infinite number, a negative frame, a score outside [0,
/// 1] and a box without area.
SSLCD_EXPORT std::map<int, std::vector<ImageDetection>> ReadBoxes(const std::string& path);

}  // namespace sslcd
