// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sslcd/core/error.h"
#include "sslcd/core/export.h"

namespace sslcd {

/// Reads a whole file. Throws Error if it is missing, cannot be read, or is
/// no regular file.
SSLCD_EXPORT std::string ReadFileBytes(const std::string& path);

/// Parses a text that is one number ("1.5x" is not). Ignores the locale; accepts "nan" and "inf".
std::optional<double> ParseNumber(std::string_view text);

/// Reads a text table row by row. A line with a comma is split at commas, any other at blanks; one
/// comma at the end is ignored. Blank lines and lines that start with '#' are skipped; CRLF and a
/// byte-order mark are accepted.
///
///   TextRows rows(path);
///   while (rows.Next()) sum += rows.Number(0);
class TextRows {
 public:
  explicit TextRows(const std::string& path);
  TextRows(const TextRows&) = delete;  // the fields point into the text
  TextRows& operator=(const TextRows&) = delete;

  /// Moves to the next row. Returns false at the end.
  bool Next();

  std::size_t size() const { return fields_.size(); }  ///< fields in this row
  bool has_commas() const { return has_commas_; }
  std::string_view Text(std::size_t column) const { return fields_.at(column); }

  /// Returns a field as a number. Throws Error with file:line and column if it is not one. Number()
  /// may be NaN or infinite.
  double Number(std::size_t column) const;
  int Integer(std::size_t column) const;

  FileLocation where() const { return {path_, line_, 0}; }
  [[noreturn]] void Fail(const std::string& message) const;  ///< throws "file:line: message"

 private:
  void Split(std::string_view line);

  std::string path_;
  std::string text_;
  std::size_t next_ = 0;  // where the next line starts
  int line_ = 0;
  bool has_commas_ = false;
  std::vector<std::string_view> fields_;
};

}  // namespace sslcd
