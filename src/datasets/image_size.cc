// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/image_size.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "formats/raw_image.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

ImageSize SizeOfRawImage(const std::string& path) {
  try {
    const RawImage image = ReadRawHeader(path);
    return {image.width, image.height};
  } catch (const Error&) {  // of a kind that is not read
    return {};
  }
}

}  // namespace

ImageSize ReadImageSize(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};  // a pipe may never end
  std::ifstream file(path, std::ios::binary);
  const auto byte = [&file] { return std::max(file.get(), 0); };
  const auto number = [&](int bytes) {
    unsigned value = 0;
    while (bytes-- > 0) value = value << 8 | static_cast<unsigned>(byte());
    return static_cast<int>(value);
  };
  const int first = number(2);
  if (first == 0x8950) {  // PNG: the first chunk starts with the size
    file.seekg(16);
    const int width = number(4), height = number(4);
    return file ? ImageSize{width, height} : ImageSize{};
  }
  if (first != 0xFFD8) return SizeOfRawImage(path);
  while (file) {  // JPEG: the start-of-frame segment has the size
    int marker = byte();
    while (marker == 0xFF) marker = byte();
    const int length = number(2);
    const bool frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame) {
      byte();  // bits per sample
      const int height = number(2), width = number(2);
      return file ? ImageSize{width, height} : ImageSize{};
    }
    if (length < 2) break;
    file.seekg(length - 2, std::ios::cur);
  }
  return {};
}

}  // namespace sslcd
