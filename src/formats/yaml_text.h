// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace sslcd {

/// The document of a YAML text. Throws YAML::ParserException for bad syntax, also in what follows
/// the document, and for a second document, which would be ignored.
inline YAML::Node ParseYaml(const std::string& text) {
  const std::vector<YAML::Node> documents = YAML::LoadAll(text);
  if (documents.size() > 1)
    throw YAML::ParserException(documents[1].Mark(),
                                "a second document begins before this: join them, or remove one");
  return documents.empty() ? YAML::Node() : documents[0];
}

}  // namespace sslcd
