// SPDX-License-Identifier: BSD-3-Clause
#include "io/xml.h"

#include <algorithm>
#include <string_view>

#include "sslcd/core/error.h"
#include "sslcd/io/text_rows.h"

namespace sslcd {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

const XmlElement* XmlElement::Find(const std::string& child) const {
  for (const XmlElement& element : children) {
    if (element.name == child) return &element;
  }
  return nullptr;
}

XmlElement ReadXml(const std::string& path) {
  const std::string bytes = ReadFileBytes(path);
  std::string_view rest = bytes;
  XmlElement document;
  // stays valid: only the innermost element gets children
  std::vector<XmlElement*> open = {&document};
  int line = 1;
  const auto fail = [&](const std::string& message) {
    throw Error(ErrorKind::kBadInput, {path, line}, message);
  };
  const auto skip = [&](std::size_t count) {
    line += static_cast<int>(
        std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
    rest.remove_prefix(count);
  };
  while (!rest.empty()) {
    const std::size_t tag = std::min(rest.find('<'), rest.size());
    open.back()->text += Trim(rest.substr(0, tag));
    skip(tag);
    if (rest.empty()) break;
    const bool comment = rest.substr(0, 4) == "<!--";
    const std::size_t end = comment ? rest.find("-->") : rest.find('>');
    if (end == std::string_view::npos) fail("a tag does not end: the file is cut off");
    const std::string_view inside = rest.substr(1, end - 1);
    if (!comment && !inside.empty() && inside[0] == '/') {
      if (open.size() == 1 || open.back()->name != Trim(inside.substr(1)))
        fail("unexpected <" + std::string(inside) + ">");
      open.pop_back();
    } else if (!comment && !inside.empty() && inside[0] != '!' && inside[0] != '?') {
      XmlElement& element = open.back()->children.emplace_back();
      element.name = std::string(inside.substr(0, inside.find_first_of(" \t\r\n/")));
      element.line = line;
      if (inside.back() != '/') open.push_back(&element);
    }
    skip(end + (comment ? 3 : 1));
  }
  if (open.size() > 1) fail("<" + open.back()->name + "> does not end: the file is cut off");
  return document;
}

}  // namespace sslcd
