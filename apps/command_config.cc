// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "examples.h"
#include "sslcd/config/config.h"
#include "sslcd/core/error.h"
#include "sslcd/version.h"
#include "sslcd_commit.h"

namespace sslcd::apps {
namespace {

namespace fs = std::filesystem;

Describe Fields(Configuration& configuration) {
  return [&configuration](FieldVisitor& visitor) { DescribeFields(visitor, configuration); };
}

fs::path FolderOf(const std::string& file) { return fs::absolute(file).parent_path(); }

// Whether a file is in the folder or below it, by its name or where links lead.
bool IsWithin(const fs::path& folder, const fs::path& file) {
  const auto below = [](const fs::path& root, const fs::path& path) {
    const fs::path from_root = path.lexically_relative(root);
    return !from_root.empty() && *from_root.begin() != "..";
  };
  std::error_code none;
  return below(fs::absolute(folder).lexically_normal(), fs::absolute(file).lexically_normal()) ||
         below(fs::weakly_canonical(folder, none), fs::weakly_canonical(file, none));
}

// A path that leads to no file stays as it is: it may not be needed.
void Resolve(const fs::path& folder, std::string& path) {
  if (path.empty()) return;
  std::error_code none;
  for (const fs::path& candidate : {folder / path, fs::absolute(path)}) {
    if (!fs::exists(candidate, none)) continue;
    path = fs::canonical(candidate).string();
    return;
  }
}

void ResolvePaths(const fs::path& folder, VisionOptions& vision) {
  for (std::string* path :
       {&vision.detector, &vision.embedder, &vision.classes, &vision.inference.library})
    Resolve(folder, *path);
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, Configuration& configuration) {
  visitor.Everyday("paper: far fewer and less certain loops; for comparison")
      .Enum("mode", configuration.mode, {"robust", "paper"},
            "which defaults: robust, or the paper's equations as printed");
  DescribeFields(visitor, configuration.options);
  visitor.Nested("vision", configuration.vision, "frames from images: detections and odometry");
}

Mode ParseMode(const std::string& name) { return name == "paper" ? Mode::kPaper : Mode::kRobust; }

void ConfigArguments::AddTo(CLI::App& command) {
  command.add_option("--config", file, "YAML file; what it does not name keeps its default");
  command.add_option("--mode", mode, "robust (default), or paper: the equations as printed")
      ->check(CLI::IsMember({"robust", "paper"}));
  command.add_option("--set", settings, "section.key=value; may be given several times")
      ->allow_extra_args(false);
}

void ConfigArguments::ApplyTo(Configuration& all) const {
  if (!file.empty()) {
    LoadConfigFile(file, Fields(all));
    ResolvePaths(FolderOf(file), all.vision);
  }
  ApplySettings(settings, Fields(all));
  ResolvePaths(fs::current_path(), all.vision);
  if (!mode.empty()) all.mode = ParseMode(mode);
}

Configuration ConfigArguments::Load() const {
  Configuration all;
  ApplyTo(all);
  // The mode sets the defaults. The file and the settings change them, so the mode is read first.
  if (all.mode != Mode::kRobust) return LoadOver(all.mode, {});
  CheckTogether(all);
  return all;
}

Configuration ConfigArguments::LoadOver(Mode defaults,
                                        const std::function<void(Configuration&)>& adapt) const {
  Configuration all{defaults, DefaultOptions(defaults), VisionOptions()};
  if (adapt) adapt(all);
  ApplyTo(all);
  CheckTogether(all);
  return all;
}

void ConfigArguments::CheckTogether(const Configuration& all) const {
  std::vector<FieldProblem> problems = Check(all.options);
  for (FieldProblem& problem : Check(all.vision)) problems.push_back(std::move(problem));
  ThrowProblems(problems, file, settings);
}

void ConfigArguments::CheckPath(const std::string& path) const {
  std::error_code none;
  if (path.empty() || fs::exists(path, none)) return;
  std::string message = "no such file in the current folder";
  if (!file.empty())
    message += ", nor in " + FolderOf(file).string() + " if it is " + file + " that names it";
  throw Error(ErrorKind::kBadInput, {path}, message);
}

void ConfigArguments::RefuseCodeFrom(const std::string& folder) const {
  if (file.empty()) return;
  Configuration named;
  LoadConfigFile(file, Fields(named));
  if (named.vision.inference.library.empty() || !IsWithin(folder, file)) return;
  throw Error(ErrorKind::kBadConfig,
              file +
                  ": vision.inference.library names code to run, and the file is in the data "
                  "set: take it out, and if you trust it, give it as --set "
                  "vision.inference.library=... or in SSLCD_ORT_LIB");
}

Command AddCheckConfigCommand(CLI::App& app, Console& console) {
  CLI::App* command =
      app.add_subcommand("check-config", "check a configuration file; all problems at once");
  const auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "YAML file")->required();
  command->footer(Examples({"check-config mine.yaml", "check-config runs/monday/config.yaml"}));
  return [file, &console] {
    ConfigArguments arguments;
    arguments.file = *file;
    arguments.Load();
    console.Say(*file + ": ok");
    return 0;
  };
}

Command AddDumpConfigCommand(CLI::App& app, Console&) {
  CLI::App* command =
      app.add_subcommand("dump-config", "print the configuration that a run would use");
  const auto arguments = std::make_shared<ConfigArguments>();
  const auto markdown = std::make_shared<bool>(false), everyday = std::make_shared<bool>(false);
  arguments->AddTo(*command);
  command->add_flag("--markdown", *markdown, "as the tables of docs/configuration.md");
  command->add_flag("--everyday", *everyday, "only the keys that users turn every day");
  command->footer(
      Examples({"dump-config --everyday", "dump-config --mode paper --set ba.max_iterations=5"}));
  return [arguments, markdown, everyday] {
    Configuration all = arguments->Load();
    const std::string text =
        *markdown ? ConfigReference(Fields(all)) : DumpConfig(Fields(all), true, *everyday);
    std::fputs(text.c_str(), stdout);
    return 0;
  };
}

std::string VersionText() {
  return std::string("sslcd ") + SSLCD_VERSION + " (commit " + Commit() + ")";
}

std::string Commit() { return SSLCD_COMMIT; }

Command AddVersionCommand(CLI::App& app) {
  app.set_version_flag("--version", VersionText());
  CLI::App* command = app.add_subcommand("version", "print the version and the commit");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print JSON");
  command->footer(Examples({"version", "version --json"}));
  return [json] {
    if (*json)
      std::printf("{\"version\": \"%s\", \"commit\": \"%s\"}\n", SSLCD_VERSION, SSLCD_COMMIT);
    else
      std::printf("%s\n", VersionText().c_str());
    return 0;
  };
}

}  // namespace sslcd::apps
