// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "formats/number_text.h"
#include "sslcd/config/config.h"

namespace sslcd {
namespace {

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

// What both printers need of a field: its value as YAML, its type and its range.
class Printer : public FieldVisitor {
 public:
  void Real(const char* key, double& value, double low, double high, const char* meaning) override {
    Field(key, ShortestNumber(value), "number", ShortestNumber(low) + " .. " + ShortestNumber(high),
          meaning);
  }
  void Integer(const char* key, int& value, int low, int high, const char* meaning) override {
    Field(key, std::to_string(value), "integer",
          std::to_string(low) + " .. " + std::to_string(high), meaning);
  }
  void Flag(const char* key, bool& value, const char* meaning) override {
    Field(key, value ? "true" : "false", "flag", "true, false", meaning);
  }
  void Text(const char* key, std::string& value, const char* meaning) override {
    Field(key, Quoted(value), "text", "", meaning);
  }
  void Choice(const char* key, int& value, const std::vector<const char*>& names,
              const char* meaning) override {
    std::string list;
    for (const char* name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    Field(key, names[value], "name", list, meaning);
  }
  void Numbers(const char* key, std::vector<double>& values, double low, double high,
               const char* meaning) override {
    std::string list;
    for (const double value : values) list += (list.empty() ? "" : ", ") + ShortestNumber(value);
    Field(key, "[" + list + "]", "numbers", ShortestNumber(low) + " .. " + ShortestNumber(high),
          meaning);
  }
  void Names(const char* key, std::map<int, std::string>& names, const char* meaning) override {
    std::string list;
    for (const auto& [number, name] : names)
      list += (list.empty() ? "" : ", ") + std::to_string(number) + ": " + Quoted(name);
    Field(key, "{" + list + "}", "names", "", meaning);
  }

  std::string text;

 protected:
  virtual void Field(const std::string& key, const std::string& value, const std::string& type,
                     const std::string& range, const std::string& meaning) = 0;
};

class YamlPrinter final : public Printer {
 public:
  explicit YamlPrinter(bool with_comments) : with_comments_(with_comments) {}

  void Section(const char* key, const char* meaning,
               const std::function<void(FieldVisitor&)>& describe) override {
    text += indent_ + key + ":" + (with_comments_ ? "  # " + std::string(meaning) : "") + "\n";
    indent_ += "  ";
    describe(*this);
    indent_.resize(indent_.size() - 2);
  }

 private:
  void Field(const std::string& key, const std::string& value, const std::string&,
             const std::string&, const std::string& meaning) override {
    text += indent_ + key + ": " + value + (with_comments_ ? "  # " + meaning : "") + "\n";
  }

  bool with_comments_;
  std::string indent_;
};

class MarkdownPrinter final : public Printer {
 public:
  void Section(const char* key, const char* meaning,
               const std::function<void(FieldVisitor&)>& describe) override {
    MarkdownPrinter inner;
    inner.path_ = path_.empty() ? key : path_ + "." + key;
    describe(inner);
    sections_ += "\n## `" + inner.path_ + "`\n" + meaning + "\n\n" + inner.Result();
  }
  std::string Result() const {
    return (text.empty()
                ? ""
                : "| key | type | default | range | meaning |\n|---|---|---|---|---|\n" + text) +
           sections_;
  }

 private:
  void Field(const std::string& key, const std::string& value, const std::string& type,
             const std::string& range, const std::string& meaning) override {
    text += "| `" + key + "` | " + type + " | " + value + " | " + range + " | " + meaning + " |\n";
  }

  std::string path_, sections_;
};

}  // namespace

std::string DumpConfig(const Describe& describe, bool with_comments) {
  YamlPrinter printer(with_comments);
  describe(printer);
  return printer.text;
}

std::string ConfigReference(const Describe& describe) {
  MarkdownPrinter printer;
  describe(printer);
  return printer.Result();
}

}  // namespace sslcd
