// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "sslcd/core/fields.h"

namespace sslcd::apps {

/// Adds a field table as command-line options: `scale_error` becomes `--scale-error`. The library
/// checks the ranges.
class OptionAdder : public FieldVisitor {
 public:
  explicit OptionAdder(CLI::App& app) : app_(app) {}
  void Real(const char* key, double& value, double, double, const char* meaning) override {
    Add(key, value, meaning);
  }
  void Integer(const char* key, int& value, int, int, const char* meaning) override {
    Add(key, value, meaning);
  }
  void Text(const char* key, std::string& value, const char* meaning) override {
    Add(key, value, meaning);
  }
  void Flag(const char* key, bool& value, const char* meaning) override {
    Add(key, value, meaning);
  }
  void Choice(const char*, int&, const std::vector<const char*>&, const char*) override {}
  void Section(const char*, const char*,
               const std::function<void(FieldVisitor&)>& describe) override {
    describe(*this);
  }

 private:
  template <class T>
  void Add(std::string key, T& value, const char* meaning) {
    // belongs to the estimator, which shares the table of detection sigmas
    if (key == "initial_scale") return;
    std::replace(key.begin(), key.end(), '_', '-');
    app_.add_option("--" + key, value, meaning)->capture_default_str();
  }
  CLI::App& app_;
};

}  // namespace sslcd::apps
