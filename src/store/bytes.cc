// SPDX-License-Identifier: BSD-3-Clause
#include "store/bytes.h"

#include <cstring>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

template <class To, class From>
To BitsOf(From value) {
  static_assert(sizeof(To) == sizeof(From));
  To bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

void Append(std::uint64_t value, int bytes, std::string& text) {
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i));
}

[[noreturn]] void FailToRead(const char* what) {
  throw Error(ErrorKind::kBadInput, std::string("an input of the map ") + what);
}

}  // namespace

ByteWriter& ByteWriter::Byte(int value) {
  bytes_ += static_cast<char>(value);
  return *this;
}
ByteWriter& ByteWriter::Int(std::int32_t value) {
  Append(static_cast<std::uint32_t>(value), 4, bytes_);
  return *this;
}
ByteWriter& ByteWriter::Long(std::int64_t value) {
  Append(static_cast<std::uint64_t>(value), 8, bytes_);
  return *this;
}
ByteWriter& ByteWriter::Real(double value) {
  Append(BitsOf<std::uint64_t>(value), 8, bytes_);
  return *this;
}
ByteWriter& ByteWriter::Float(float value) {
  Append(BitsOf<std::uint32_t>(value), 4, bytes_);
  return *this;
}
ByteWriter& ByteWriter::Reals(const double* values, int count) {
  for (int i = 0; i < count; ++i) Real(values[i]);
  return *this;
}
ByteWriter& ByteWriter::Text(std::string_view text) {
  Int(static_cast<std::int32_t>(text.size()));
  bytes_ += text;
  return *this;
}

std::uint64_t ByteReader::Unsigned(int bytes) {
  if (bytes_.size() < static_cast<std::size_t>(bytes)) FailToRead("is cut short");
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i)
    value |= std::uint64_t{static_cast<unsigned char>(bytes_[static_cast<std::size_t>(i)])}
             << (8 * i);
  bytes_.remove_prefix(static_cast<std::size_t>(bytes));
  return value;
}

int ByteReader::Byte() { return static_cast<int>(Unsigned(1)); }
std::int32_t ByteReader::Int() {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(Unsigned(4)));
}
std::int64_t ByteReader::Long() { return static_cast<std::int64_t>(Unsigned(8)); }
double ByteReader::Real() { return BitsOf<double>(Unsigned(8)); }
float ByteReader::Float() { return BitsOf<float>(static_cast<std::uint32_t>(Unsigned(4))); }
void ByteReader::Reals(double* values, int count) {
  for (int i = 0; i < count; ++i) values[i] = Real();
}

std::string ByteReader::Text() {
  const auto size = static_cast<std::size_t>(Count(1));
  std::string text(bytes_.substr(0, size));
  bytes_.remove_prefix(size);
  return text;
}

int ByteReader::Count(int item_bytes) {
  const std::int32_t count = Int();
  if (count < 0 ||
      static_cast<std::size_t>(count) > bytes_.size() / static_cast<unsigned>(item_bytes))
    FailToRead("has an impossible length");
  return count;
}

void ByteReader::ExpectEnd() const {
  if (!bytes_.empty()) FailToRead("is too long");
}

}  // namespace sslcd
