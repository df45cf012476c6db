// SPDX-License-Identifier: BSD-3-Clause
#include "formats/text_rows.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

#include "core/regular_file.h"

namespace sslcd {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

std::string ReadFileBytes(const std::string& path) {
  RequireRegularFile(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  std::string bytes;
  if (file) {
    char block[1 << 16];
    while (const std::size_t count = std::fread(block, 1, sizeof(block), file.get()))
      bytes.append(block, count);
  }
  if (!file || std::ferror(file.get()) != 0) {
    const std::string reason = std::strerror(errno);
    throw Error(ErrorKind::kBadInput, {path},
                "cannot be read (" + reason + "): check the path and its permissions");
  }
  return bytes;
}

std::optional<double> ParseNumber(std::string_view text) {
  // from_chars accepts no plus sign
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

TextRows::TextRows(const std::string& path) : path_(path), text_(ReadFileBytes(path)) {
  if (text_.compare(0, 3, "\xEF\xBB\xBF") == 0) next_ = 3;
}

bool TextRows::Next() {
  while (next_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', next_), text_.size());
    const std::string_view line = Trim(std::string_view(text_).substr(next_, end - next_));
    next_ = end + 1;
    ++line_;
    if (line.empty() || line[0] == '#') continue;
    Split(line);
    return true;
  }
  fields_.clear();
  return false;
}

void TextRows::Split(std::string_view line) {
  fields_.clear();
  has_commas_ = line.find(',') != std::string_view::npos;
  const std::string_view separators = has_commas_ ? "," : kBlanks;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(separators), line.size());
    fields_.push_back(Trim(line.substr(0, end)));
    line = end < line.size() ? Trim(line.substr(end + 1)) : std::string_view();
  }
}

double TextRows::Number(std::size_t column) const {
  const std::string_view text = Text(column);
  const std::optional<double> value = ParseNumber(text);
  if (!value)
    Fail("column " + std::to_string(column + 1) + ": expected a number, found '" +
         std::string(text) + "'");
  return *value;
}

int TextRows::Integer(std::size_t column) const {
  const double value = Number(column);
  if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::floor(value)) {
    Fail("column " + std::to_string(column + 1) + ": expected a whole number, found '" +
         std::string(Text(column)) + "'");
  }
  return static_cast<int>(value);
}

void TextRows::Fail(const std::string& message) const {
  throw Error(ErrorKind::kBadInput, where(), message);
}

}  // namespace sslcd
