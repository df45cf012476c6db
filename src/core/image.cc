// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/image.h"

#include <string>

#include "sslcd/core/error.h"

namespace sslcd {

void CheckImage(const ImageView& image, const char* what) {
  const auto refuse = [what](const std::string& why) {
    throw Error(ErrorKind::kBadInput, std::string(what) + ": " + why);
  };
  if (!image.data || image.width <= 0 || image.height <= 0) refuse("it is empty");
  if (image.channels != 1 && image.channels != 3)
    refuse("it has " + std::to_string(image.channels) + " channels; give grey (1) or B G R (3)");
  if (image.stride < image.channels * static_cast<std::size_t>(image.width))
    refuse("its stride is shorter than a row");
}

void CheckImages(const StereoView& images) {
  CheckImage(images.left, "left image");
  CheckImage(images.right, "right image");
  if (images.left.width == images.right.width && images.left.height == images.right.height) return;
  const auto size = [](const ImageView& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
  };
  throw Error(ErrorKind::kBadInput, "the left image is " + size(images.left) + ", the right one " +
                                        size(images.right) + ": give rectified images of one size");
}

}  // namespace sslcd
