// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "check/repaired_files.h"
#include "check/report_text.h"
#include "check_dataset.h"
#include "commands.h"
#include "dataset_options.h"
#include "datasets/sequence_writer.h"
#include "examples.h"
#include "overwriting.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"

namespace sslcd::apps {
namespace {

constexpr int kMistakeFound = 6;

struct CheckArguments {
  DatasetRequest request;
  std::string fix;
  bool json = false, mistakes = false;
};

void AddOptions(CLI::App& command, CheckArguments& a) {
  command.add_option("DATASET", a.request.path, "dataset folder");
  AddTo(command, a.request);
  command.add_option("--groundtruth", a.request.groundtruth, "poses, likewise");
  command.add_option(
      "--fix", a.fix,
      "folder to write: the sequence with the mistakes corrected that were found; refused if one "
      "cannot be corrected");
  command.add_flag("--json", a.json, "print JSON");
  command.add_flag("--mistakes", a.mistakes, "print what is tested as a Markdown table, and end");
  command.footer("Exit code 6: a mistake was found.\n\n" +
                 Examples({"check my_sequence",
                           "check kitti/training --sequence 0007 --detections det --odometry poses",
                           "check my_sequence --fix corrected"}));
}

int Check(CheckArguments& a, const Console& console) {
  if (a.mistakes) {
    std::fputs(check::MistakesMarkdown().c_str(), stdout);
    return 0;
  }
  if (a.request.path.empty())
    throw Error(ErrorKind::kUsage, "name a dataset folder: sslcd_run check DATASET");
  a.request.odometry_policy = a.request.detections_policy = PartPolicy::kIfThere;
  const Dataset dataset = LoadDataset(a.request);
  for (const std::string& warning : dataset.warnings) Log(LogLevel::kWarning, warning);
  const check::CheckReport report = CheckDataset(a.request, dataset);
  if (a.json)
    std::fputs(check::ReportJson(report).c_str(), stdout);
  else
    console.Say(check::ReportText(report));
  if (!a.fix.empty()) {
    const SequenceFiles files = check::RepairedFiles(report);
    RefuseFolder(a.request.path, a.fix);
    const FileLock lock = PrepareSequenceFolder(a.fix, false, "choose another folder or empty it");
    WriteSequenceFiles(a.fix, files);
    if (!a.json) console.Say("wrote " + a.fix);
    return 0;
  }
  return report.mistakes() > 0 ? kMistakeFound : 0;
}

}  // namespace

Command AddCheckCommand(CLI::App& app, Console& console) {
  CLI::App* command =
      app.add_subcommand("check", "test a dataset for the mistakes that people make");
  const auto arguments = std::make_shared<CheckArguments>();
  AddOptions(*command, *arguments);
  command->add_flag("-q,--quiet", console.quiet, "print errors only");
  return [arguments, &console] {
    console.InstallLog();
    return Check(*arguments, console);
  };
}

}  // namespace sslcd::apps
