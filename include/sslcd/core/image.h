// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace sslcd {

/// Somebody else's 8-bit image, rows from the top. Nothing is copied or freed.
struct ImageView {
  const unsigned char* data = nullptr;
  int width = 0, height = 0;  ///< [px]
  std::size_t stride = 0;     ///< bytes from one row to the next
  int channels = 3;           ///< 3: interleaved B G R; 1: grey
};

/// Two images of one moment, rectified: a point lies in the same row of both.
struct StereoView {
  ImageView left, right;
};

/// Throws Error(kBadInput), with `what` in front, unless the image has pixels, one or three channels and a stride that
/// holds a row.
void CheckImage(const ImageView& image, const char* what);

/// CheckImage on both, and both have the same size.
void CheckImages(const StereoView& images);

}  // namespace sslcd
