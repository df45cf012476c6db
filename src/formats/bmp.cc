// SPDX-License-Identifier: BSD-3-Clause
#include "formats/raw_file.h"

namespace sslcd {
namespace {

constexpr int kGreyTable = 256 * 4;  // bytes of a table of colours

/// Whether the table of colours maps each value to its grey.
bool IsGreyTable(RawFile& file, std::uint64_t place) {
  std::vector<unsigned char> table(kGreyTable);
  file.Read(place, table.size(), table.data());
  for (int i = 0; i < 256; ++i)
    for (int channel = 0; channel < 3; ++channel)
      if (table[4 * i + channel] != i) return false;
  return true;
}

}  // namespace

RawImage ReadBmpHeader(RawFile& file) {
  const std::uint32_t pixels = file.At(10, 4), header = file.At(14, 4);
  if (header < 40) file.Refuse("is a BMP of an old kind");
  const std::uint32_t width = file.At(18, 4), bits = file.At(28, 2), compression = file.At(30, 4);
  std::uint32_t height = file.At(22, 4);
  const bool from_top = height >> 31;  // a negative height
  if (from_top) height = 0 - height;
  CheckRawSize(file, width, height);
  constexpr std::uint32_t kBitFields = 3;
  if (compression == kBitFields) file.Refuse("is a BMP with bit fields instead of 24 bits a pixel");
  if (compression != 0) file.Refuse("is a compressed BMP");
  if (bits != 8 && bits != 24 && bits != 32)
    file.Refuse("is a BMP of " + std::to_string(bits) + " bits a pixel");
  if (bits == 8 && !IsGreyTable(file, std::uint64_t{14} + header))
    file.Refuse("is a BMP with a table of colours");

  RawImage image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.bytes_per_pixel = static_cast<int>(bits / 8);
  const std::uint64_t step = (image.RowBytes() + 3) / 4 * 4;
  for (std::uint64_t row = 0; row < height; ++row)
    image.rows.push_back(pixels + step * (from_top ? row : height - 1 - row));
  return image;
}

}  // namespace sslcd
