// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sslcd/core/image.h"

namespace sslcd {

/// The place of the pixels in an image file without compression.
struct RawImage {
  int width = 0, height = 0;        ///< [px]
  int bytes_per_pixel = 3;          ///< 1: grey; 3: colour; 4: colour and a byte to leave out
  bool rgb = false;                 ///< order of the colours: R G B, else B G R
  std::vector<std::uint64_t> rows;  ///< where each row begins in the file, from the top

  std::uint64_t RowBytes() const { return std::uint64_t(width) * bytes_per_pixel; }
};

/// Whether the file begins as a BMP or a TIFF. False for what is no regular file.
bool IsRawImage(const std::string& path);

/// Reads the header of a BMP or of the first image of a TIFF. Both are read here rather than by a
/// library, because images come from other people: of these formats only the plain kind is needed,
/// 8 bits a channel without compression. Throws Error(kBadInput) with a way out for any other kind,
/// for damaged files, and for files that are shorter than their pixels.
RawImage ReadRawHeader(const std::string& path);

/// Reads the pixels, as grey or B G R. Throws the errors of ReadRawHeader.
Image ReadRawImage(const std::string& path);

}  // namespace sslcd
