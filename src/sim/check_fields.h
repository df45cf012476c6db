// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "sslcd/core/error.h"
#include "sslcd/core/fields.h"

namespace sslcd::sim {

/// Collects every field that is outside its range.
class FieldChecker : public FieldVisitor {
 public:
  void Real(const char* key, double& value, double low, double high, const char*) override {
    Check(key, value, low, high);
  }
  void Integer(const char* key, int& value, int low, int high, const char*) override {
    Check(key, value, low, high);
  }
  void Flag(const char*, bool&, const char*) override {}
  void Text(const char*, std::string&, const char*) override {}
  void Choice(const char*, int&, const std::vector<const char*>&, const char*) override {}
  void Section(const char*, const char*,
               const std::function<void(FieldVisitor&)>& describe) override {
    describe(*this);
  }
  const std::string& problems() const { return problems_; }

 private:
  template <class T>
  void Check(const char* key, T value, T low, T high) {
    if (value >= low && value <= high) return;  // false for NaN
    problems_ += std::string(problems_.empty() ? "" : "; ") + key + " is " + Short(value) +
                 ", must be " + Short(low) + " to " + Short(high);
  }
  template <class T>
  static std::string Short(T value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", static_cast<double>(value));
    return text;
  }

  std::string problems_;
};

/// Throws Error(kUsage) with all problems at once.
template <class Options>
void CheckFields(Options options) {
  FieldChecker checker;
  DescribeFields(checker, options);
  if (!checker.problems().empty()) throw Error(ErrorKind::kUsage, checker.problems());
}

}  // namespace sslcd::sim
