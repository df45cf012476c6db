// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "formats/text_rows.h"
#include "formats/yaml_text.h"
#include "sslcd/config/config.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

// The name that a key is most like, if it is like one.
std::optional<std::string> Nearest(const std::string& key, const std::vector<std::string>& names) {
  std::size_t least = std::max<std::size_t>(2, key.size() / 3) + 1;
  std::optional<std::string> nearest;
  for (const std::string& name : names) {
    const std::size_t longer = std::max(key.size(), name.size()),
                      shorter = std::min(key.size(), name.size());
    if (longer - shorter >= least) continue;  // so many letters differ at least
    const std::size_t distance = EditDistance(key, name);
    if (distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

std::string Plain(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

// Walks the fields and a YAML tree in parallel. The first pass collects problems and changes
// nothing; the second pass applies the values.
class ConfigLoader final : public FieldVisitor {
 public:
  ConfigLoader(const YAML::Node& root, std::string name, bool marks, bool apply)
      : node_(root), name_(std::move(name)), marks_(marks), apply_(apply) {}

  const std::vector<std::string>& problems() const { return problems_; }

  void Root(const Describe& describe) {
    if (!node_.IsDefined() || node_.IsNull()) return;  // an empty file changes nothing
    if (!node_.IsMap())
      return Problem(node_, "expected a map of sections, e.g. 'ba: {max_iterations: 30}'");
    CheckDuplicates();
    describe(*this);
    CheckUnknown();
  }

  void Real(const char* key, double& value, double low, double high, const char*) override {
    Scalar(key, "a number", [&](const YAML::Node& node) {
      const std::optional<double> number = ParseNumber(node.Scalar());
      if (!number) return WrongType(node, key, "a number");
      if (!(*number >= low && *number <= high))
        return OutOfRange(node, key, Plain(low), Plain(high));
      if (apply_) value = *number;
    });
  }

  void Integer(const char* key, int& value, int low, int high, const char*) override {
    Scalar(key, "a whole number", [&](const YAML::Node& node) {
      const std::optional<double> number = ParseNumber(node.Scalar());
      const bool digits = node.Scalar().find_first_not_of("+-0123456789") == std::string::npos;
      if (!number || !digits) return WrongType(node, key, "a whole number");
      if (!(*number >= low && *number <= high))
        return OutOfRange(node, key, std::to_string(low), std::to_string(high));
      if (apply_) value = static_cast<int>(*number);
    });
  }

  void Flag(const char* key, bool& value, const char*) override {
    Scalar(key, "true or false", [&](const YAML::Node& node) {
      if (node.Scalar() != "true" && node.Scalar() != "false")
        return WrongType(node, key, "true or false");
      if (apply_) value = node.Scalar() == "true";
    });
  }

  void Text(const char* key, std::string& value, const char*) override {
    Scalar(key, "a text", [&](const YAML::Node& node) {
      if (apply_) value = node.Scalar();
    });
  }

  void Choice(const char* key, int& value, const std::vector<const char*>& names,
              const char*) override {
    Scalar(key, "a name", [&](const YAML::Node& node) {
      std::string list;
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (node.Scalar() == names[i]) {
          if (apply_) value = static_cast<int>(i);
          return;
        }
        list += (i ? ", " : "") + std::string(names[i]);
      }
      Problem(node,
              "'" + std::string(key) + "' is '" + node.Scalar() + "', must be one of " + list);
    });
  }

  void Numbers(const char* key, std::vector<double>& values, double low, double high,
               const char*) override {
    const std::optional<YAML::Node> node =
        Collection(key, YAML::NodeType::Sequence, "a list of numbers, e.g. [1, 2]");
    if (!node) return;
    std::vector<double> read;
    for (const auto& item : *node) {
      const std::optional<double> number =
          item.IsScalar() ? ParseNumber(item.Scalar()) : std::nullopt;
      if (!number) return WrongType(item, key, "a list of numbers");
      if (!(*number >= low && *number <= high))
        return OutOfRange(item, key, Plain(low), Plain(high));
      read.push_back(*number);
    }
    if (apply_) values = read;
  }

  void Names(const char* key, std::map<int, std::string>& names, const char*) override {
    const std::optional<YAML::Node> node =
        Collection(key, YAML::NodeType::Map, "names by number, e.g. {2: Car, 7: Truck}");
    if (!node) return;
    std::map<int, std::string> read;
    for (const auto& entry : *node) {
      const std::string number = entry.first.IsScalar() ? entry.first.Scalar() : "";
      if (number.empty() || number.size() > 6 ||
          number.find_first_not_of("0123456789") != std::string::npos)
        return Problem(entry.first, "'" + std::string(key) + "' has '" + number +
                                        "', must be a whole number >= 0");
      if (!entry.second.IsScalar()) return WrongType(entry.second, key, "names by number");
      if (!read.emplace(std::stoi(number), entry.second.Scalar()).second)
        return Problem(entry.first, "duplicate number " + number + " in '" + key + "'");
    }
    if (apply_) names = read;
  }

  void Section(const char* key, const char*,
               const std::function<void(FieldVisitor&)>& describe) override {
    known_.push_back(key);
    const std::optional<YAML::Node> child = Find(key);
    if (!child || child->IsNull()) return;
    if (!child->IsMap())
      return Problem(*child, "'" + std::string(key) + "' is a section: expected a map of keys");
    const YAML::Node outer = node_;
    std::vector<std::string> outer_known = std::move(known_);
    const std::string outer_path = path_;
    node_.reset(*child);
    known_.clear();
    path_ = key;
    CheckDuplicates();
    describe(*this);
    CheckUnknown();
    node_.reset(outer);
    known_ = std::move(outer_known);
    path_ = outer_path;
  }

 private:
  std::optional<YAML::Node> Find(const char* key) const {
    for (const auto& entry : node_)
      if (entry.first.IsScalar() && entry.first.Scalar() == key) return entry.second;
    return std::nullopt;
  }

  /// The list or map of this key; none if the key is missing or has another type.
  std::optional<YAML::Node> Collection(const char* key, YAML::NodeType::value type,
                                       const char* expected) {
    known_.push_back(key);
    std::optional<YAML::Node> node = Find(key);
    if (!node || node->Type() == type) return node;
    WrongType(*node, key, expected);
    return std::nullopt;
  }

  template <class Use>
  void Scalar(const char* key, const char* expected, const Use& use) {
    known_.push_back(key);
    const std::optional<YAML::Node> node = Find(key);
    if (!node) return;
    if (!node->IsScalar()) return WrongType(*node, key, expected);
    use(*node);
  }

  void Problem(const YAML::Node& at, const std::string& message) {
    FileLocation where{name_, 0, 0};
    const YAML::Mark mark = at.Mark();
    if (marks_ && !mark.is_null()) where = {name_, mark.line + 1, mark.column + 1};
    problems_.push_back(ToString(where) + ": " + message);
  }

  void WrongType(const YAML::Node& node, const std::string& key, const std::string& expected) {
    const std::string found = node.IsScalar() ? "'" + node.Scalar() + "'"
                              : node.IsNull() ? "nothing"
                                              : "a list or map";
    Problem(node, "'" + key + "' is " + found + ", must be " + expected);
  }

  void OutOfRange(const YAML::Node& node, const std::string& key, const std::string& low,
                  const std::string& high) {
    Problem(node, "'" + key + "' is " + node.Scalar() + ", must be in [" + low + ", " + high + "]");
  }

  void CheckDuplicates() {  // yaml-cpp keeps them silently
    std::set<std::string> seen;
    for (const auto& entry : node_)
      if (entry.first.IsScalar() && !seen.insert(entry.first.Scalar()).second)
        Problem(entry.first, "duplicate key '" + entry.first.Scalar() + "'" + In());
  }

  void CheckUnknown() {
    for (const auto& entry : node_) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      std::string message = "unknown key '" + key + "'" + In();
      if (const auto nearest = Nearest(key, known_))
        message += " - did you mean '" + *nearest + "'?";
      Problem(entry.first, message);
    }
  }

  std::string In() const { return path_.empty() ? "" : " in '" + path_ + "'"; }

  YAML::Node node_;
  std::string name_;
  bool marks_, apply_;
  std::string path_;
  std::vector<std::string> known_, problems_;
};

void Throw(const std::vector<std::string>& problems) {
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + problem;
  throw Error(ErrorKind::kBadConfig, text);
}

// Line and column of a key with its sections; none if the file lacks the key.
std::optional<FileLocation> Locate(const YAML::Node& root, const std::string& key,
                                   const std::string& path) {
  YAML::Node node = root;
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '.');) {
    if (!node.IsMap() || !node[part]) return std::nullopt;
    node.reset(node[part]);
  }
  return FileLocation{path, node.Mark().line + 1, node.Mark().column + 1};
}

// The place that sets the value of one of `keys`.
std::string SourceOf(const std::vector<std::string>& keys, const YAML::Node& root,
                     const std::string& path, const std::vector<std::string>& settings) {
  for (auto setting = settings.rbegin(); setting != settings.rend(); ++setting)
    for (const std::string& key : keys)
      if (setting->rfind(key + "=", 0) == 0) return "--set " + *setting;
  for (const std::string& key : keys)
    if (const auto at = Locate(root, key, path)) return ToString(*at);
  return keys.at(0);
}

}  // namespace

void ThrowProblems(const std::vector<FieldProblem>& problems, const std::string& path,
                   const std::vector<std::string>& settings) {
  if (problems.empty()) return;
  const YAML::Node root = path.empty() ? YAML::Node() : ParseYaml(ReadFileBytes(path));
  std::vector<std::string> lines;
  for (const FieldProblem& problem : problems)
    lines.push_back(SourceOf(problem.keys, root, path, settings) + ": " + problem.message);
  Throw(lines);
}

void LoadConfigText(const std::string& text, const std::string& name, const Describe& describe) {
  YAML::Node root;
  try {
    root = ParseYaml(text);
  } catch (const YAML::ParserException& problem) {
    throw Error(ErrorKind::kBadConfig, {name, problem.mark.line + 1, problem.mark.column + 1},
                problem.msg);
  }
  ConfigLoader check(root, name, true, false);
  check.Root(describe);
  if (!check.problems().empty()) Throw(check.problems());
  ConfigLoader(root, name, true, true).Root(describe);
}

void LoadConfigFile(const std::string& path, const Describe& describe) {
  LoadConfigText(ReadFileBytes(path), path, describe);
}

void ApplySettings(const std::vector<std::string>& settings, const Describe& describe) {
  std::vector<std::string> problems;
  std::vector<std::pair<YAML::Node, std::string>> trees;
  for (const std::string& setting : settings) {
    const std::string name = "--set " + setting;
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      problems.push_back(name + ": expected key=value, e.g. ba.max_iterations=30");
      continue;
    }
    YAML::Node tree(setting.substr(equals + 1));
    std::string key = setting.substr(0, equals);
    for (std::size_t dot; !key.empty(); key = dot == std::string::npos ? "" : key.substr(0, dot)) {
      dot = key.rfind('.');
      YAML::Node parent(YAML::NodeType::Map);
      parent[dot == std::string::npos ? key : key.substr(dot + 1)] = tree;
      tree.reset(parent);
    }
    ConfigLoader check(tree, name, false, false);
    check.Root(describe);
    problems.insert(problems.end(), check.problems().begin(), check.problems().end());
    trees.emplace_back(tree, name);
  }
  if (!problems.empty()) Throw(problems);
  for (const auto& [tree, name] : trees) ConfigLoader(tree, name, false, true).Root(describe);
}

}  // namespace sslcd
