// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame_shader.h"
#include "render/options.h"

namespace sslcd::render {

/// Converts light to the bytes of a colour image (blue, green, red): vignetting, exposure,
/// compressed highlights, gamma 2, and noise that depends on `seed` and the pixel's number.
std::vector<std::uint8_t> Develop(const std::vector<Sample>& samples, int width, int height,
                                  float exposure, const RenderOptions& options, std::uint32_t seed);

}  // namespace sslcd::render
