// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "sslcd/core/error.h"
#include "sslcd/io/config.h"

namespace sslcd::apps {
namespace {

Describe Fields(Configuration& configuration) {
  return [&configuration](FieldVisitor& visitor) { DescribeFields(visitor, configuration); };
}

}  // namespace

void DescribeFields(FieldVisitor& visitor, Configuration& configuration) {
  DescribeFields(visitor, configuration.options);
  visitor.Nested("vision", configuration.vision, "frames from images: detections and odometry");
}

void ConfigArguments::AddTo(CLI::App& command) {
  command.add_option("--config", file, "YAML file; what it does not name keeps its default");
  command.add_option("--mode", mode, "robust (default), or paper: the equations as printed")
      ->check(CLI::IsMember({"robust", "paper"}));
  command.add_option("--set", settings, "section.key=value; may be given several times")->allow_extra_args(false);
}

Configuration ConfigArguments::Load(const std::function<void(Configuration&)>& adapt) const {
  // The mode decides the defaults that the file and the settings then change, wherever it is named.
  Configuration all;
  const auto apply = [&] {
    if (!file.empty()) LoadConfigFile(file, Fields(all));
    ApplySettings(settings, Fields(all));
    if (!mode.empty()) all.options.mode = mode == "paper" ? Options::Mode::kPaper : Options::Mode::kRobust;
  };
  apply();
  all = {DefaultOptions(all.options.mode), VisionOptions()};
  if (adapt) adapt(all);
  apply();
  return all;
}

Command AddCheckConfigCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand("check-config", "check a configuration file; all problems at once");
  const auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "YAML file")->required();
  return [file, &console] {
    Configuration all;
    LoadConfigFile(*file, Fields(all));
    console.Say(*file + ": ok");
    return 0;
  };
}

Command AddDumpConfigCommand(CLI::App& app, Console&) {
  CLI::App* command = app.add_subcommand("dump-config", "print the configuration that a run would use");
  const auto arguments = std::make_shared<ConfigArguments>();
  const auto markdown = std::make_shared<bool>(false);
  arguments->AddTo(*command);
  command->add_flag("--markdown", *markdown, "as the tables of docs/configuration.md");
  return [arguments, markdown] {
    Configuration all = arguments->Load();
    const std::string text = *markdown ? ConfigReference(Fields(all)) : DumpConfig(Fields(all), true);
    std::fputs(text.c_str(), stdout);
    return 0;
  };
}

Command AddVersionCommand(CLI::App& app) {
  app.add_subcommand("version", "print the version");
  return [] {
    std::printf("sslcd %s\n", SSLCD_VERSION);
    return 0;
  };
}

}  // namespace sslcd::apps
