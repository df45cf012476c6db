// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

namespace sslcd {

/// Width and height [px].
using ImageSize = std::array<int, 2>;

/// Reads the size from the header of a PNG or JPEG file, or of a BMP or TIFF that is read here
/// (formats/raw_image.h); zero if the file has no such header.
ImageSize ReadImageSize(const std::string& path);

}  // namespace sslcd
