// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cstdio>
#include <string>

namespace sslcd {

/// The shortest text that reads back as the same number, whatever the locale.
inline std::string ShortestNumber(double value) {
  char buffer[32];
  return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

/// With a fixed number of decimals; never "-0.000".
inline std::string FixedNumber(double value, int decimals) {
  char buffer[400];
  std::string text(
      buffer,
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals).ptr);
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

/// Numbers as printf writes them; a whole row of a table fits.
template <class... Values>
std::string FormatNumbers(const char* format, Values... values) {
  char text[512];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace sslcd
