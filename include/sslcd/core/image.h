// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace sslcd {

/// Somebody else's 8-bit image, rows from the top. Nothing is copied or freed.
struct ImageView {
  const unsigned char* data = nullptr;
  int width = 0, height = 0;  ///< [px]
  std::size_t stride = 0;     ///< bytes from one row to the next
  int channels = 3;           ///< 3: interleaved B G R; 1: grey
};

/// An image of our own, rows without gaps. No pixels: there is none.
struct Image {
  std::vector<unsigned char> pixels;
  int width = 0, height = 0, channels = 3;

  bool empty() const { return pixels.empty(); }
  ImageView view() const {
    return {pixels.data(), width, height,
            static_cast<std::size_t>(width) * static_cast<std::size_t>(channels), channels};
  }
};

/// Two images of one moment, rectified: a point lies in the same row of both.
struct StereoView {
  ImageView left, right;
};

/// Throws Error(kBadInput), with `what` in front, unless the image has pixels, one or three
/// channels and a stride that holds a row.
void CheckImage(const ImageView& image, const char* what);

/// CheckImage on both, and both have the same size.
void CheckImages(const StereoView& images);

}  // namespace sslcd
