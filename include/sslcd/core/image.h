// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

/// A view of an 8-bit image, rows from the top. It does not own the pixels.
struct ImageView {
  const unsigned char* data = nullptr;
  int width = 0, height = 0;  ///< [px]
  std::size_t stride = 0;     ///< bytes from one row to the next
  int channels = 3;           ///< 3: interleaved B G R; 1: grey
};

/// An image that owns its pixels, rows without gaps. Without pixels it is empty.
struct Image {
  std::vector<unsigned char> pixels;
  int width = 0, height = 0, channels = 3;

  bool empty() const { return pixels.empty(); }
  ImageView view() const {
    return {pixels.data(), width, height,
            static_cast<std::size_t>(width) * static_cast<std::size_t>(channels), channels};
  }
};

/// A rectified stereo pair: a point has the same row in both images.
struct StereoView {
  ImageView left, right;
};

/// Throws Error(kBadInput) with the prefix `what` unless the image has pixels, one or three
/// channels and a stride of at least a row.
void CheckImage(const ImageView& image, const char* what);

/// CheckImage for both images. Also throws Error(kBadInput) if their sizes differ.
void CheckImages(const StereoView& images);

}  // namespace sslcd
