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

// A field for printing: its value as YAML, its type and its range.
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

std::string Joined(const std::string& path, const char* key) {
  return path.empty() ? key : path + "." + key;
}

class YamlPrinter final : public Printer {
 public:
  YamlPrinter(bool with_comments, bool everyday_only)
      : with_comments_(with_comments), everyday_only_(everyday_only) {}

  void Section(const char* key, const char* meaning,
               const std::function<void(FieldVisitor&)>& describe) override {
    const std::string before = text;
    text += indent_ + key + ":" + (with_comments_ ? "  # " + std::string(meaning) : "") + "\n";
    const std::string head = text;
    indent_ += "  ";
    describe(*this);
    indent_.resize(indent_.size() - 2);
    if (text == head && everyday_only_) text = before;
  }

 private:
  void Field(const std::string& key, const std::string& value, const std::string&,
             const std::string&, const std::string& meaning) override {
    const bool everyday = TakeEffect() != nullptr;
    if (everyday_only_ && !everyday) return;
    text += indent_ + key + ": " + value + (with_comments_ ? "  # " + meaning : "") + "\n";
  }

  bool with_comments_, everyday_only_;
  std::string indent_;
};

class MarkdownPrinter final : public Printer {
 public:
  void Section(const char* key, const char* meaning,
               const std::function<void(FieldVisitor&)>& describe) override {
    MarkdownPrinter inner;
    inner.path_ = Joined(path_, key);
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

// The table of the everyday keys.
class EverydayPrinter final : public Printer {
 public:
  void Section(const char* key, const char*,
               const std::function<void(FieldVisitor&)>& describe) override {
    const std::string outer = path_;
    path_ = Joined(path_, key);
    describe(*this);
    path_ = outer;
  }

 private:
  void Field(const std::string& key, const std::string& value, const std::string&,
             const std::string& range, const std::string& meaning) override {
    const char* effect = TakeEffect();
    if (effect == nullptr) return;
    text += "| `" + Joined(path_, key.c_str()) + "` | " + value + " | " + range + " | " + meaning +
            " | " + effect + " |\n";
  }

  std::string path_;
};

}  // namespace

std::string DumpConfig(const Describe& describe, bool with_comments, bool everyday_only) {
  YamlPrinter printer(with_comments, everyday_only);
  describe(printer);
  return printer.text;
}

std::string ConfigReference(const Describe& describe) {
  EverydayPrinter everyday;
  describe(everyday);
  MarkdownPrinter all;
  describe(all);
  if (everyday.text.empty()) return all.Result();
  return "## Everyday\nThe keys that most users change.\n\n"
         "| key | default | range | meaning | what you see when you turn it |\n"
         "|---|---|---|---|---|\n" +
         everyday.text + "\n## All keys\n" + all.Result();
}

}  // namespace sslcd
