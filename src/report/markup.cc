// SPDX-License-Identifier: BSD-3-Clause
#include "report/markup.h"

namespace sslcd {
namespace {

// U+FFFE or U+FFFF begins here, which XML 1.0 does not allow.
bool IsNoCharacter(const std::string& text, std::size_t at) {
  return text.compare(at, 3, "\xEF\xBF\xBE") == 0 || text.compare(at, 3, "\xEF\xBF\xBF") == 0;
}

}  // namespace

std::string MarkupText(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (IsNoCharacter(text, i))
      i += 2;
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '&')
      escaped += "&amp;";
    else if (c == '"')
      escaped += "&quot;";
    else if (c == '\n' || static_cast<unsigned char>(c) >= 0x20)
      escaped += c;
  }
  return escaped;
}

}  // namespace sslcd
