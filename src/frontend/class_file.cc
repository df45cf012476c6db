// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/class_file.h"

#include <cmath>
#include <limits>

#include "formats/text_rows.h"
#include "formats/yaml_text.h"
#include "sslcd/config/config.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

/// Marks all values as missing: a value that is still NaN after loading was not in the file.
ClassPrior Unset() {
  constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();
  return {kUnset, kUnset, kUnset, kUnset, kUnset, kUnset, kUnset, kUnset};
}

/// Lists the keys without a value.
class MissingKeys final : public FieldVisitor {
 public:
  void Real(const char* key, double& value, double, double, const char*) override {
    if (std::isnan(value)) keys += (keys.empty() ? "" : ", ") + std::string(key);
  }
  void Integer(const char*, int&, int, int, const char*) override {}
  void Flag(const char*, bool&, const char*) override {}
  void Text(const char*, std::string&, const char*) override {}
  void Choice(const char*, int&, const std::vector<const char*>&, const char*) override {}
  void Section(const char*, const char*, const std::function<void(FieldVisitor&)>&) override {}

  std::string keys;
};

/// The labels and their places. LoadConfigText reports the problems of the file.
std::map<std::string, YAML::Mark> Labels(const std::string& text) {
  std::map<std::string, YAML::Mark> labels;
  try {
    const YAML::Node root = ParseYaml(text);
    if (!root.IsMap()) return labels;
    for (const auto& entry : root)
      if (entry.first.IsScalar()) labels.emplace(entry.first.Scalar(), entry.first.Mark());
  } catch (const YAML::ParserException&) {
  }
  return labels;
}

}  // namespace

std::map<std::string, ClassPrior> LoadClasses(const std::string& path) {
  const std::string text = ReadFileBytes(path);
  const std::map<std::string, YAML::Mark> labels = Labels(text);
  std::map<std::string, ClassPrior> classes;
  for (const auto& [label, mark] : labels) classes[label] = Unset();
  LoadConfigText(text, path, [&](FieldVisitor& visitor) {
    for (auto& [label, prior] : classes) visitor.Nested(label.c_str(), prior, "");
  });
  if (classes.empty())
    throw Error(ErrorKind::kBadConfig, {path},
                "names no class; expected e.g. 'Car: {length_m: 3.93, ...}' (config/classes.yaml)");
  std::string problems;
  for (auto& [label, prior] : classes) {
    MissingKeys missing;
    DescribeFields(missing, prior);
    if (missing.keys.empty()) continue;
    const YAML::Mark& mark = labels.at(label);
    problems += (problems.empty() ? "" : "\n") + path + ":" + std::to_string(mark.line + 1) + ":" +
                std::to_string(mark.column + 1) + ": class '" + label + "' lacks " + missing.keys;
  }
  if (!problems.empty()) throw Error(ErrorKind::kBadConfig, problems);
  return classes;
}

}  // namespace sslcd
