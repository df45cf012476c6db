// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <string>

namespace sslcd {

/// The shortest text that reads back as the same number, whatever the locale.
inline std::string ShortestNumber(double value) {
  char buffer[32];
  return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

/// The number with this many decimals, whatever the locale; never "-0.000".
inline std::string FixedNumber(double value, int decimals) {
  char buffer[400];
  std::string text(
      buffer,
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals).ptr);
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

/// The number with this many significant digits, like printf's %g, whatever the locale.
inline std::string RoundedNumber(double value, int digits) {
  char buffer[400];
  return std::string(
      buffer,
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr);
}

}  // namespace sslcd
