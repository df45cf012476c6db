// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "console.h"
#include "sslcd/frontend/options.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::apps {

/// Each function adds a subcommand to `app`. The returned Command runs it and returns the exit
/// code.
using Command = std::function<int()>;
Command AddRunCommand(CLI::App& app, Console& console);
Command AddDetectCommand(CLI::App& app, Console& console);
Command AddCheckCommand(CLI::App& app, Console& console);
Command AddEvalCommand(CLI::App& app, Console& console);
Command AddDrawCommand(CLI::App& app, Console& console);
Command AddExportCommand(CLI::App& app, Console& console);
Command AddReportCommand(CLI::App& app, Console& console);
Command AddCompareCommand(CLI::App& app, Console& console);
Command AddMatchCommand(CLI::App& app, Console& console);
Command AddGraphCommand(CLI::App& app, Console& console);
Command AddMapCommand(CLI::App& app, Console& console);
Command AddRelocaliseCommand(CLI::App& app, Console& console);
Command AddSitesCommand(CLI::App& app, Console& console);
Command AddBenchCommand(CLI::App& app, Console& console);
Command AddCheckConfigCommand(CLI::App& app, Console& console);
Command AddDumpConfigCommand(CLI::App& app, Console& console);
Command AddVersionCommand(CLI::App& app);

/// All keys of a configuration file: the library's options, and the image frontend's under
/// `vision`.
struct Configuration {
  /// the preset that set the defaults; single options may differ from it
  Mode mode = Mode::kRobust;
  Options options;
  VisionOptions vision;
};
void DescribeFields(FieldVisitor& visitor, Configuration& configuration);

/// "sslcd 1.2.3 (commit 0123456789ab)".
std::string VersionText();
/// Of the program: 12 hexadecimal digits, or "unknown" if it was not built in a checkout.
std::string Commit();

/// "robust" or "paper".
Mode ParseMode(const std::string& name);

/// --config, --mode and --set, shared by several subcommands.
struct ConfigArguments {
  std::string file, mode;
  std::vector<std::string> settings;

  void AddTo(CLI::App& command);
  /// Loads the defaults of the mode, then the file, then the settings. Paths in the file are
  /// relative to the file, otherwise to the current folder; paths of settings are relative to the
  /// current folder. Paths that are found become absolute, so a dump works in any folder. Throws
  /// Error(kBadConfig).
  Configuration Load() const;
  /// The same with other defaults: those of `mode`, changed by `adapt`.
  Configuration LoadOver(Mode mode, const std::function<void(Configuration&)>& adapt) const;
  /// Throws Error(kBadInput) with the searched places if a path of the configuration leads to no
  /// file.
  void CheckPath(const std::string& path) const;
  /// Throws Error(kBadConfig) if the file came with the data in `folder` and names a library, whose
  /// code would run.
  void RefuseCodeFrom(const std::string& folder) const;

 private:
  void ApplyTo(Configuration& configuration) const;
  /// Throws one Error(kBadConfig) with all options that do not fit together.
  void CheckTogether(const Configuration& configuration) const;
};

}  // namespace sslcd::apps
