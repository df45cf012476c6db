// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <sstream>
#include <string>

namespace sslcd {

/// Reads over a document and keeps the place where it begins.
class YamlDocumentStart : public YAML::EventHandler {
 public:
  YAML::Mark mark;

  void OnDocumentStart(const YAML::Mark& start) override { mark = start; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

/// The document of a YAML text. Throws YAML::ParserException for bad syntax, also in what follows
/// the document, and for a second document, which would be ignored.
inline YAML::Node ParseYaml(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  YamlDocumentStart document;
  // YAML::LoadAll would not end for a closing bracket at the top: it finds documents for ever.
  if (!parser.HandleNextDocument(document)) return {};
  if (parser.HandleNextDocument(document))
    throw YAML::ParserException(document.mark,
                                "a second document begins here: join them, or remove one");
  return YAML::Load(text);
}

}  // namespace sslcd
