// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "formats/raw_image.h"

namespace sslcd {

/// Numbers of a binary file at any place. Every read beyond the end throws Error(kBadInput).
class RawFile {
 public:
  /// Throws Error(kBadInput) for what is no regular file that can be read.
  explicit RawFile(const std::string& path);

  bool little_endian = true;
  std::uint64_t size() const { return size_; }
  /// An unsigned number of 1 to 4 bytes.
  std::uint32_t At(std::uint64_t place, int bytes);
  void Read(std::uint64_t place, std::uint64_t bytes, unsigned char* out);
  /// Throws Error(kBadInput): path, message, and the way to another format.
  [[noreturn]] void Refuse(const std::string& message) const;

 private:
  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
};

RawImage ReadBmpHeader(RawFile& file);
RawImage ReadTiffHeader(RawFile& file);

/// Throws unless width and height are a small image's, so that all sizes can be multiplied.
void CheckRawSize(const RawFile& file, std::uint64_t width, std::uint64_t height);

}  // namespace sslcd
