// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd {

struct XmlElement {
  std::string name;
  std::string text;  ///< all text directly inside, trimmed
  int line = 0;
  std::vector<XmlElement> children;

  const XmlElement* Find(const std::string& child) const;  ///< the first of that name; null: none
};

/// The XML that boost::serialization writes: elements and text; attributes, declarations and
/// comments are skipped, entities left as they are. Returns a nameless element around the root.
/// Throws Error with file:line.
XmlElement ReadXml(const std::string& path);

}  // namespace sslcd
