// SPDX-License-Identifier: BSD-3-Clause
#include "formats/raw_image.h"

#include <algorithm>
#include <filesystem>

#include "core/regular_file.h"
#include "formats/raw_file.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr std::uint64_t kLongestSide = 1 << 16;  // [px]

enum class RawKind { kNone, kBmp, kTiff };

RawKind KindOf(RawFile& file) {
  if (file.size() < 8) return RawKind::kNone;
  file.little_endian = true;
  const std::uint32_t first = file.At(0, 4);
  if ((first & 0xFFFF) == 0x4D42) return RawKind::kBmp;  // "BM"
  file.little_endian = first != 0x2A004D4D;              // "MM" 0 42
  return first == 0x002A4949 || !file.little_endian ? RawKind::kTiff : RawKind::kNone;
}

RawImage HeaderOf(RawFile& file) {
  const RawKind kind = KindOf(file);
  if (kind == RawKind::kNone) file.Refuse("is neither a BMP nor a TIFF");
  RawImage image = kind == RawKind::kBmp ? ReadBmpHeader(file) : ReadTiffHeader(file);
  // Rows may share bytes, so the sum bounds the memory as well.
  if (image.rows.size() * image.RowBytes() > file.size()) file.Refuse("is shorter than its pixels");
  for (const std::uint64_t row : image.rows)
    if (row > file.size() || image.RowBytes() > file.size() - row)
      file.Refuse("is shorter than its pixels");
  return image;
}

}  // namespace

RawFile::RawFile(const std::string& path) : path_(path) {
  RequireRegularFile(path);
  file_.open(path, std::ios::binary | std::ios::ate);
  if (!file_) throw Error(ErrorKind::kBadInput, {path}, "cannot be read: check the path");
  size_ = static_cast<std::uint64_t>(file_.tellg());
}

void RawFile::Refuse(const std::string& message) const {
  throw Error(ErrorKind::kBadInput, {path_},
              message + "; save it as PNG, e.g. with 'mogrify -format png' (docs/formats.md)");
}

void RawFile::Read(std::uint64_t place, std::uint64_t bytes, unsigned char* out) {
  if (place > size_ || bytes > size_ - place) Refuse("ends too early");
  file_.seekg(static_cast<std::streamoff>(place));
  file_.read(reinterpret_cast<char*>(out), static_cast<std::streamsize>(bytes));
  if (!file_) Refuse("cannot be read to its end");
}

std::uint32_t RawFile::At(std::uint64_t place, int bytes) {
  unsigned char read[4];
  Read(place, bytes, read);
  std::uint32_t value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8 | read[little_endian ? bytes - 1 - i : i];
  return value;
}

void CheckRawSize(const RawFile& file, std::uint64_t width, std::uint64_t height) {
  if (width == 0 || height == 0 || width > kLongestSide || height > kLongestSide)
    file.Refuse("has " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
}

bool IsRawImage(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;  // a pipe may never end
  try {
    RawFile file(path);
    return KindOf(file) != RawKind::kNone;
  } catch (const Error&) {
    return false;
  }
}

RawImage ReadRawHeader(const std::string& path) {
  RawFile file(path);
  return HeaderOf(file);
}

Image ReadRawImage(const std::string& path) {
  RawFile file(path);
  const RawImage raw = HeaderOf(file);
  Image image{{}, raw.width, raw.height, raw.bytes_per_pixel == 1 ? 1 : 3};
  image.pixels.reserve(std::size_t(raw.width) * raw.height * image.channels);
  std::vector<unsigned char> row(raw.RowBytes());
  for (const std::uint64_t place : raw.rows) {
    file.Read(place, row.size(), row.data());
    for (std::size_t i = 0; i < row.size(); i += raw.bytes_per_pixel) {
      if (raw.rgb) std::swap(row[i], row[i + 2]);
      image.pixels.insert(image.pixels.end(), row.begin() + i, row.begin() + i + image.channels);
    }
  }
  return image;
}

}  // namespace sslcd
