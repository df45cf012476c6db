// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/fields.h"

#include <sstream>

namespace sslcd {
namespace {

class RangeChecker final : public FieldVisitor {
 public:
  void Real(const char* key, double& value, double low, double high, const char*) override {
    Check(key, value, low, high);
  }
  void Integer(const char* key, int& value, int low, int high, const char*) override {
    Check(key, value, low, high);
  }
  void Flag(const char*, bool&, const char*) override {}
  void Text(const char*, std::string&, const char*) override {}
  void Choice(const char* key, int& value, const std::vector<const char*>& names,
              const char*) override {
    Check(key, value, 0, static_cast<int>(names.size()) - 1);
  }
  void Numbers(const char* key, std::vector<double>& values, double low, double high,
               const char*) override {
    for (const double value : values) Check(key, value, low, high);
  }
  void Section(const char* key, const char*,
               const std::function<void(FieldVisitor&)>& describe) override {
    const std::string outer = path_;
    path_ += std::string(key) + ".";
    describe(*this);
    path_ = outer;
  }

  std::vector<FieldProblem> problems;

 private:
  template <class T>
  void Check(const char* key, T value, T low, T high) {
    if (value >= low && value <= high) return;  // false for NaN
    std::ostringstream text;
    text << "'" << key << "' is " << value << ", must be in [" << low << ", " << high << "]";
    problems.push_back({{path_ + key}, text.str()});
  }

  std::string path_;
};

}  // namespace

std::vector<FieldProblem> CheckRanges(const std::function<void(FieldVisitor&)>& describe) {
  RangeChecker checker;
  describe(checker);
  return checker.problems;
}

std::string ToString(const std::vector<FieldProblem>& problems) {
  std::string text;
  for (const FieldProblem& problem : problems)
    text += (text.empty() ? "" : "\n") + problem.keys.at(0) + ": " + problem.message;
  return text;
}

}  // namespace sslcd
