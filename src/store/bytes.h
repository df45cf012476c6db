// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sslcd {

/// Numbers as bytes, least significant byte first, on every machine: IEEE 754 doubles and floats
/// bit by bit, so that NaN and -0 survive, which columns of SQLite change.
class ByteWriter {
 public:
  ByteWriter& Byte(int value);
  ByteWriter& Int(std::int32_t value);
  ByteWriter& Long(std::int64_t value);
  ByteWriter& Real(double value);
  ByteWriter& Float(float value);
  ByteWriter& Reals(const double* values, int count);
  ByteWriter& Text(std::string_view text);  ///< its length, and its bytes
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter has written. Throws Error(kBadInput) beyond the end.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  int Byte();
  std::int32_t Int();
  std::int64_t Long();
  double Real();
  float Float();
  void Reals(double* values, int count);
  std::string Text();
  /// A number of items of at least `item_bytes` each; throws if so many cannot follow.
  int Count(int item_bytes);
  void ExpectEnd() const;  ///< throws if something is left

 private:
  std::uint64_t Unsigned(int bytes);

  std::string_view bytes_;
};

}  // namespace sslcd
