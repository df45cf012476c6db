// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace sslcd::fuzz {

/// Values out of bytes; zeros after their end.
class Script {
 public:
  explicit Script(std::string bytes) : bytes_(std::move(bytes)) {}

  bool AtEnd() const { return next_ >= bytes_.size(); }
  unsigned Byte() { return AtEnd() ? 0 : static_cast<unsigned char>(bytes_[next_++]); }
  /// Of 0 to count - 1.
  unsigned Choice(unsigned count) { return Byte() % count; }
  /// From -1 to nearly 1.
  double Share() { return (static_cast<double>(Byte()) - 128) / 128; }
  /// Mostly of moderate size; one in eight is of any bits, NaN and infinity among them.
  double Real() {
    const unsigned kind = Byte();
    if (kind % 8 != 0) return Share() * (kind % 8 == 1 ? 1e6 : kind);
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | Byte();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  std::string bytes_;
  std::size_t next_ = 0;
};

}  // namespace sslcd::fuzz
