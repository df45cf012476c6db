// SPDX-License-Identifier: BSD-3-Clause
// The fields of an options struct as a list, and a way to set one by its key.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sslcd/core/fields.h"

namespace sslcd {

struct Leaf {
  std::string key;           // with its sections
  std::string value;         // to all digits
  bool number = false;       // has a range
  bool integer = false;      // of whole numbers
  double low = 0, high = 0;  // of a number; of a flag or a choice, of its index
};

using Fields = std::function<void(FieldVisitor&)>;

// Visits all fields with their full key as numbers: flags and choices by their index.
class LeafVisitor : public FieldVisitor {
 public:
  void Real(const char* key, double& value, double low, double high, const char*) override {
    OnNumber(path_ + key, value, low, high, false);
  }
  void Integer(const char* key, int& value, int low, int high, const char*) override {
    double number = value;
    OnNumber(path_ + key, number, low, high, true);
    value = static_cast<int>(number);
  }
  void Flag(const char* key, bool& value, const char*) override {
    int index = value ? 1 : 0;
    OnChoice(path_ + key, index, 2);
    value = index != 0;
  }
  void Text(const char*, std::string&, const char*) override {}
  void Choice(const char* key, int& value, const std::vector<const char*>& names,
              const char*) override {
    OnChoice(path_ + key, value, static_cast<int>(names.size()));
  }
  void Section(const char* key, const char*, const Fields& describe) override {
    const std::string outer = path_;
    path_ += std::string(key) + ".";
    describe(*this);
    path_ = outer;
  }

 protected:
  virtual void OnNumber(const std::string& key, double& value, double low, double high,
                        bool integer) = 0;
  virtual void OnChoice(const std::string& key, int& index, int count) = 0;

 private:
  std::string path_;
};

inline std::vector<Leaf> FindLeaves(const Fields& describe) {
  struct Finder final : LeafVisitor {
    void OnNumber(const std::string& key, double& value, double low, double high,
                  bool integer) override {
      char text[32];
      std::snprintf(text, sizeof text, "%.17g", value);
      leaves.push_back({key, text, true, integer, low, high});
    }
    void OnChoice(const std::string& key, int& index, int count) override {
      leaves.push_back({key, std::to_string(index), false, true, 0, count - 1.});
    }
    std::vector<Leaf> leaves;
  } finder;
  describe(finder);
  return finder.leaves;
}

// Flags and choices take the index.
inline void SetNumber(const std::string& key, double value, const Fields& describe) {
  struct Setter final : LeafVisitor {
    void OnNumber(const std::string& at, double& field, double, double, bool) override {
      if (at == key) field = value;
    }
    void OnChoice(const std::string& at, int& index, int) override {
      if (at == key) index = static_cast<int>(value);
    }
    std::string key;
    double value = 0;
  } setter;
  setter.key = key;
  setter.value = value;
  describe(setter);
}

}  // namespace sslcd
