// SPDX-License-Identifier: BSD-3-Clause
#include "configuration.h"

#include <pybind11/stl.h>

#include "bindings.h"
#include "sslcd/core/error.h"

namespace sslcd::python {
namespace {

// The keys of a configuration, but for `vision`.
struct Configuration {
  Mode mode = Mode::kRobust;
  Options options;
};

Describe Fields(Configuration& configuration) {
  return [&configuration](FieldVisitor& visitor) {
    visitor.Enum("mode", configuration.mode, {"robust", "paper"}, "which defaults");
    DescribeFields(visitor, configuration.options);
  };
}

class DictVisitor final : public FieldVisitor {
 public:
  const py::dict& dict() const { return dict_; }

  void Real(const char* key, double& value, double, double, const char*) override {
    dict_[key] = value;
  }
  void Integer(const char* key, int& value, int, int, const char*) override { dict_[key] = value; }
  void Flag(const char* key, bool& value, const char*) override { dict_[key] = value; }
  void Text(const char* key, std::string& value, const char*) override { dict_[key] = value; }
  void Choice(const char* key, int& value, const std::vector<const char*>& names,
              const char*) override {
    dict_[key] = names.at(static_cast<std::size_t>(value));
  }
  void Section(const char* key, const char*,
               const std::function<void(FieldVisitor&)>& describe) override {
    DictVisitor section;
    describe(section);
    dict_[key] = section.dict();
  }

 private:
  py::dict dict_;
};

// Problems of settings begin with the flag of the command line.
std::string WithoutFlag(const std::string& message) {
  static const std::string flag = "--set ";
  std::string text = "\n" + message;
  for (std::size_t at = 0; (at = text.find("\n" + flag, at)) != std::string::npos;)
    text.erase(at + 1, flag.size());
  return text.substr(1);
}

// The mode sets the defaults, which `load` changes, so the mode is read first.
template <class Load>
Configuration LoadOverMode(const Load& load) {
  Configuration all;
  load(Fields(all));
  if (all.mode == Mode::kRobust) return all;
  all.options = DefaultOptions(all.mode);
  load(Fields(all));
  return all;
}

Configuration FromSettings(const std::vector<std::string>& settings) {
  Configuration all = LoadOverMode([&](const Describe& describe) { Apply(settings, describe); });
  try {
    ThrowProblems(Check(all.options), "", settings);
  } catch (const Error& error) {
    throw Error(error.kind(), WithoutFlag(error.what()));
  }
  return all;
}

py::dict ReadOptions(const std::string& text, const std::string& path) {
  Configuration all =
      LoadOverMode([&](const Describe& describe) { LoadConfigText(text, path, describe); });
  ThrowProblems(Check(all.options), path, {});
  return DictOf(Fields(all));
}

}  // namespace

void Apply(const std::vector<std::string>& settings, const Describe& describe) {
  try {
    ApplySettings(settings, describe);
  } catch (const Error& error) {
    throw Error(error.kind(), WithoutFlag(error.what()));
  }
}

Options OptionsFrom(const std::vector<std::string>& settings) {
  return FromSettings(settings).options;
}

std::string ConfigText(const std::vector<std::string>& settings) {
  Configuration all = FromSettings(settings);
  return DumpConfig(Fields(all), false);
}

py::dict DictOf(const Describe& describe) {
  DictVisitor visitor;
  describe(visitor);
  return visitor.dict();
}

void BindConfiguration(py::module_& module) {
  module.def(
      "options",
      [](const std::vector<std::string>& settings) {
        Configuration all = FromSettings(settings);
        return DictOf(Fields(all));
      },
      py::arg("settings"));
  module.def("read_options", &ReadOptions, py::arg("text"), py::arg("path"));
}

}  // namespace sslcd::python
