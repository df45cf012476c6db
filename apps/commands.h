// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "console.h"
#include "sslcd/frontend/options.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::apps {

/// Each adds a subcommand to `app`; the returned function carries it out and gives the exit code.
using Command = std::function<int()>;
Command AddRunCommand(CLI::App& app, Console& console);
Command AddDetectCommand(CLI::App& app, Console& console);
Command AddEvalCommand(CLI::App& app, Console& console);
Command AddMatchCommand(CLI::App& app, Console& console);
Command AddGraphCommand(CLI::App& app, Console& console);
Command AddBenchCommand(CLI::App& app, Console& console);
Command AddCheckConfigCommand(CLI::App& app, Console& console);
Command AddDumpConfigCommand(CLI::App& app, Console& console);
Command AddVersionCommand(CLI::App& app);

/// Everything a configuration file may hold: the library's options and, in `vision`, how frames
/// come from images.
struct Configuration {
  /// the preset that was taken; the other options may differ from it
  Mode mode = Mode::kRobust;
  Options options;
  VisionOptions vision;
};
void DescribeFields(FieldVisitor& visitor, Configuration& configuration);

/// "sslcd 1.2.3 (commit 0123456789ab)".
std::string VersionText();

/// "robust" or "paper".
Mode ParseMode(const std::string& name);

/// --config, --mode and --set, shared by several subcommands.
struct ConfigArguments {
  std::string file, mode;
  std::vector<std::string> settings;

  void AddTo(CLI::App& command);
  /// Defaults of the mode, then the file, then the settings. Paths in the file are relative to it,
  /// or else to the current folder, as those of settings are; what is found becomes absolute, so
  /// that it can be written anywhere. Throws Error(kBadConfig).
  Configuration Load() const;
  /// The same over other defaults: those of `mode`, as `adapt` changes them.
  Configuration LoadOver(Mode mode, const std::function<void(Configuration&)>& adapt) const;
  /// Throws Error(kBadInput) with the places looked at where a path of the configuration leads
  /// nowhere.
  void CheckPath(const std::string& path) const;

 private:
  void ApplyTo(Configuration& configuration) const;
  /// Options that do not fit together: all problems in one Error(kBadConfig).
  void CheckTogether(const Configuration& configuration) const;
};

}  // namespace sslcd::apps
