// SPDX-License-Identifier: BSD-3-Clause
#include "formats/npy.h"

#include <charconv>
#include <cstring>
#include <string_view>

#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

[[noreturn]] void Fail(const std::string& path, const std::string& message) {
  throw Error(ErrorKind::kBadInput, {path},
              message + "; save it as np.save(path, np.ascontiguousarray(x, '<f4'))");
}

/// The text after "'key':" in the header, which is a Python dict.
std::string_view ValueOf(const std::string& path, std::string_view header, const std::string& key) {
  const std::size_t at = header.find("'" + key + "'");
  const std::size_t colon = at == std::string_view::npos ? at : header.find(':', at);
  if (colon == std::string_view::npos) Fail(path, "the npy header has no '" + key + "'");
  std::string_view value = header.substr(colon + 1);
  value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
  return value;
}

/// "(rows, columns)"
void ParseShape(const std::string& path, std::string_view text, NpyMatrix& matrix) {
  text = text.substr(0, text.find(')'));
  std::vector<std::size_t> shape;
  for (const char* at = text.data(); at != text.data() + text.size();) {
    std::size_t size = 0;
    const auto [end, error] = std::from_chars(at, text.data() + text.size(), size);
    if (error == std::errc()) shape.push_back(size);
    at = error == std::errc() ? end : at + 1;
  }
  if (shape.size() != 2)
    Fail(path,
         "expected an array of two dimensions, rows x dim, found " + std::to_string(shape.size()));
  matrix.rows = shape[0];
  matrix.columns = shape[1];
}

template <class T>
void CopyValues(const std::string& path, std::string_view data, NpyMatrix& matrix) {
  const std::size_t count = data.size() / sizeof(T);
  const bool fits = matrix.columns == 0
                        ? count == 0
                        : count / matrix.columns == matrix.rows && count % matrix.columns == 0;
  if (!fits || data.size() % sizeof(T) != 0) {
    Fail(path, "the size of the data does not match the shape: the file is truncated or too long");
  }
  matrix.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    T value;
    std::memcpy(&value, data.data() + i * sizeof(T), sizeof(T));
    matrix.values[i] = static_cast<float>(value);
  }
}

}  // namespace

NpyMatrix ReadNpy(const std::string& path) {
  const std::string bytes = ReadFileBytes(path);
  std::string_view data = bytes;
  if (data.size() < 10 || data.substr(0, kMagic.size()) != kMagic)
    Fail(path, "not a NumPy .npy file");
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
  };
  // version 1; later versions have a length of four bytes
  std::size_t start = 10, length = byte(8) | byte(9) << 8;
  if (byte(6) > 1 && data.size() >= 12) start = 12, length |= byte(10) << 16 | byte(11) << 24;
  if (byte(6) < 1 || byte(6) > 3 || length > data.size() - start)
    Fail(path, "unknown npy version, or the header is truncated");

  const std::string_view header = data.substr(start, length);
  data.remove_prefix(start + length);
  NpyMatrix matrix;
  ParseShape(path, ValueOf(path, header, "shape"), matrix);
  if (ValueOf(path, header, "fortran_order").substr(0, 4) == "True")
    Fail(path, "the array is in Fortran order, expected C");
  const std::string_view type = ValueOf(path, header, "descr").substr(0, 5);
  if (type == "'<f4'") {
    CopyValues<float>(path, data, matrix);
  } else if (type == "'<f8'") {
    CopyValues<double>(path, data, matrix);
  } else {
    Fail(path, "expected float32 or float64, found " + std::string(type));
  }
  return matrix;
}

std::string NpyBytes(const NpyMatrix& matrix) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                       std::to_string(matrix.rows) + ", " + std::to_string(matrix.columns) + "), }";
  // as NumPy does, so that the data is aligned
  constexpr std::size_t kBefore = 10, kAlign = 64;
  header.append(kAlign - 1 - (kBefore + header.size()) % kAlign, ' ');
  header += '\n';
  std::string bytes(kMagic);
  bytes +=
      {'\x01', '\0', static_cast<char>(header.size() & 255), static_cast<char>(header.size() >> 8)};
  bytes += header;
  const std::size_t start = bytes.size(), size = matrix.values.size() * sizeof(float);
  bytes.resize(start + size);
  if (size > 0) std::memcpy(&bytes[start], matrix.values.data(), size);
  return bytes;
}

}  // namespace sslcd
