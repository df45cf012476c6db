// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/drawing.h"

namespace sslcd::apps {

/// Returns a PNG file of the drawing, with two pixels for each of its own in both directions.
std::string PngBytes(const Drawing& drawing);

}  // namespace sslcd::apps
