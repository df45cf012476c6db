// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sslcd/core/export.h"

namespace sslcd {

/// SHA-256 (FIPS 180-4), so that other programs can check a store's checksums, e.g. by Python's
/// hashlib.
class SSLCD_EXPORT Sha256 {
 public:
  Sha256& Add(std::string_view bytes);
  /// The 32 bytes of the hash of all that was added. Ends the computation.
  std::string Finish();

 private:
  void Compress(const unsigned char* block);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> block_{};
  std::size_t filled_ = 0;  // bytes of block_
  std::uint64_t bytes_ = 0;
};

inline constexpr std::size_t kSha256Bytes = 32;

/// Lower-case hexadecimal digits of bytes.
SSLCD_EXPORT std::string Hexadecimal(std::string_view bytes);

}  // namespace sslcd
