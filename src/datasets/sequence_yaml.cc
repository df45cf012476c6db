// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/sequence_yaml.h"

#include <cmath>
#include <set>

#include "formats/number_text.h"
#include "formats/text_rows.h"
#include "formats/yaml_text.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

class SequenceYamlReader {
 public:
  explicit SequenceYamlReader(const std::string& path) : path_(path) {}

  SequenceInfo Read() const {
    SequenceInfo info;
    YAML::Node root;
    try {
      root = ParseYaml(ReadFileBytes(path_));
    } catch (const YAML::Exception& error) {
      Fail(error.mark, error.msg);
    }
    if (root.IsNull()) return info;
    CheckKeys(root, {"up_axis", "image_size_px", "labels"});
    if (root["up_axis"]) info.up_axis = UpAxis(root["up_axis"]);
    if (root["image_size_px"]) ReadImageSize(root["image_size_px"], info);
    if (root["labels"]) info.labels = Labels(root["labels"]);
    return info;
  }

 private:
  [[noreturn]] void Fail(const YAML::Mark& mark, const std::string& message) const {
    throw Error(ErrorKind::kBadInput, {path_, mark.line + 1, mark.column + 1}, message);
  }

  /// Refuses duplicate keys (yaml-cpp keeps both silently) and, unless `known` is empty, unknown
  /// keys.
  void CheckKeys(const YAML::Node& node, const std::set<std::string>& known) const {
    if (!node.IsMap()) Fail(node.Mark(), "expected a mapping 'key: value'");
    std::string names;
    for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
    std::set<std::string> seen;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) Fail(entry.first.Mark(), "expected a plain key");
      const std::string key = entry.first.Scalar();
      if (!seen.insert(key).second) Fail(entry.first.Mark(), "duplicate key '" + key + "'");
      if (!known.empty() && known.count(key) == 0) {
        Fail(entry.first.Mark(), "unknown key '" + key + "'; known here: " + names);
      }
    }
  }

  double Number(const YAML::Node& node, const std::string& key) const {
    const auto value = node.IsScalar() ? ParseNumber(node.Scalar()) : std::nullopt;
    if (!value) Fail(node.Mark(), key + ": expected a number");
    return *value;
  }

  Vec3 UpAxis(const YAML::Node& node) const {
    if (!node.IsSequence() || node.size() != 3)
      Fail(node.Mark(), "up_axis: expected three numbers, like [0, -1, 0]");
    const Vec3 up(Number(node[0], "up_axis"), Number(node[1], "up_axis"),
                  Number(node[2], "up_axis"));
    const double length = up.norm();
    if (!(length > 1e-6 && std::isfinite(length)))
      Fail(node.Mark(), "up_axis: expected a direction, not zero, NaN or beyond all numbers");
    return up / length;
  }

  void ReadImageSize(const YAML::Node& node, SequenceInfo& info) const {
    if (!node.IsSequence() || node.size() != 2)
      Fail(node.Mark(), "image_size_px: expected width and height, like [1242, 375]");
    const double width = Number(node[0], "image_size_px"),
                 height = Number(node[1], "image_size_px");
    for (const double side : {width, height})
      if (!(side >= 1 && side <= 1e5 && side == std::floor(side)))
        Fail(node.Mark(), "image_size_px: expected whole numbers of pixels, like [1242, 375]");
    info.image_width = static_cast<int>(width);
    info.image_height = static_cast<int>(height);
  }

  LabelTable Labels(const YAML::Node& node) const {
    CheckKeys(node, {});
    LabelTable labels;
    for (const auto& entry : node) {
      CheckKeys(entry.second, {"symmetry"});
      LabelInfo info;
      if (const YAML::Node symmetry = entry.second["symmetry"]) {
        const auto parsed = symmetry.IsScalar() ? ParseSymmetry(symmetry.Scalar()) : std::nullopt;
        if (!parsed) Fail(symmetry.Mark(), "symmetry: expected none, pi or full");
        info.symmetry = *parsed;
      }
      labels.Set(entry.first.Scalar(), info);
    }
    return labels;
  }

  std::string path_;
};

/// A word that no version of YAML takes for a number, a truth value or null.
bool IsPlainWord(const std::string& text) {
  static const std::set<std::string> reserved = {"y",    "n",     "yes", "no",  "on",
                                                 "true", "false", "off", "null"};
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::string lower;
  for (const char c : text) {
    if (!is_letter(c) && c != '_' && (lower.empty() || !(c >= '0' && c <= '9'))) return false;
    lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return !lower.empty() && reserved.count(lower) == 0;
}

/// Quoted, with bytes from 0x80 as they are.
std::string QuotedBytes(const std::string& text) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte == 0x7f)
      quoted += std::string("\\x") + kDigits[byte >> 4] + kDigits[byte & 0xf];
    else
      quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return quoted + "\"";
}

std::string Quoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  // The emitter writes U+FFFD for what is not UTF-8: two labels in Latin-1 would become one.
  return YAML::Load(emitter.c_str()).Scalar() == text ? emitter.c_str() : QuotedBytes(text);
}

/// A label as a key that every YAML reader takes for this text (if it is UTF-8), up to its value.
std::string YamlKey(const std::string& label) {
  constexpr std::size_t kMostImplicit = 1000;  // 1024 characters in YAML 1.2, 7.4.2
  const std::string key = IsPlainWord(label) ? label : Quoted(label);
  return key.size() <= kMostImplicit ? "  " + key + ": " : "  ? " + key + "\n  : ";
}

}  // namespace

SequenceInfo ReadSequenceYaml(const std::string& path) { return SequenceYamlReader(path).Read(); }

std::string SequenceYamlText(const SequenceInfo& info) {
  std::string text;
  if (info.up_axis)
    text += "up_axis: [" + RoundedNumber(info.up_axis->x(), 9) + ", " +
            RoundedNumber(info.up_axis->y(), 9) + ", " + RoundedNumber(info.up_axis->z(), 9) +
            "]\n";
  if (info.image_width > 0)
    text += "image_size_px: [" + std::to_string(info.image_width) + ", " +
            std::to_string(info.image_height) + "]\n";
  if (!info.labels.entries().empty()) text += "labels:\n";
  for (const auto& [label, of_label] : info.labels.entries())
    text += YamlKey(label) + "{symmetry: " + ToString(of_label.symmetry) + "}\n";
  return text;
}

}  // namespace sslcd
