// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "datasets/run_folder.h"
#include "examples.h"
#include "formats/atomic_file.h"
#include "formats/files.h"
#include "overwriting.h"
#include "report/report_data.h"
#include "report/report_page.h"
#include "report_file.h"
#include "report_images.h"
#include "sslcd/core/error.h"
#include "written.h"

namespace sslcd::apps {
namespace {

struct ReportArguments {
  std::vector<std::string> runs;
  std::string out, groundtruth;
  bool no_images = false, json = false;
};

// The name of the sequence, and of the folder where several have the same.
std::vector<std::string> NamesOf(const std::vector<RunView>& runs) {
  std::vector<std::string> names;
  for (const RunView& run : runs)
    names.push_back(run.record && !run.record->dataset.empty() ? run.record->dataset
                                                               : LastName(run.folder));
  const std::vector<std::string> given = names;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (std::count(given.begin(), given.end(), given[i]) > 1) names[i] += ": " + runs[i].folder;
  return names;
}

nlohmann::ordered_json RunsJson(const std::vector<RunView>& runs) {
  auto list = nlohmann::ordered_json::array();
  for (const RunView& run : runs)
    list.push_back({{"run", run.folder},
                    {"frames", run.trajectory.size()},
                    {"objects", run.map.objects.size()},
                    {"attempts", run.loops.size()},
                    {"loops", AcceptedLoops(run).size()}});
  return {{"runs", list}};
}

}  // namespace

std::string PagePath(const std::string& run) {
  return (std::filesystem::path(run) / "report.html").string();
}

void RefusePage(const PageRequest& page) {
  std::vector<std::string> read = page.read;
  read.push_back(page.groundtruth);
  for (const std::string& run : page.runs) {
    for (const std::string& path : RunFolderPaths(run)) read.push_back(path);
    if (!IsFile(run + "/run.json")) continue;
    for (const FileRecord& input : ReadRunJson(run + "/run.json").inputs)
      read.push_back(input.name);
  }
  RefuseOverwriting(read, {page.out}, page.option);
}

std::vector<RunView> WriteReport(const PageRequest& page) {
  RequireReportLibraries();
  RefusePage(page);
  std::vector<RunView> views;
  for (const std::string& run : page.runs) {
    views.push_back(ReadRun(run, page.groundtruth));
    if (page.images) AddLoopImages(views.back());
    if (!page.metrics.empty()) views.back().metrics_json = page.metrics;
  }
  const std::vector<std::string> names = NamesOf(views);
  const std::string title = views.size() == 1 ? names[0] : std::to_string(views.size()) + " runs";
  WriteFileAtomically(page.out, ReportPage(ReportJson(views, names), title + " - sslcd"));
  return views;
}

Command AddReportCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand(
      "report",
      "make a page of finished runs: 3D map, loops, errors; any browser opens it offline");
  const auto a = std::make_shared<ReportArguments>();
  command->add_option("RUN", a->runs, "folders written by 'sslcd_run run'")->required();
  command->add_option("--out", a->out, "page to write; default: report.html in the first RUN");
  command->add_option("--groundtruth", a->groundtruth,
                      "true poses; default: those that the run was compared with");
  command->add_flag("--no-images", a->no_images,
                    "no crops of the run's images, e.g. in a page for others");
  command->add_flag("--json", a->json, "print what was written as JSON and nothing else");
  command->footer(
      Examples({"report runs/monday", "report runs/monday runs/tuesday --out both.html --json"}));
  return [a, &console] {
    if (a->json) console.quiet = true;
    console.InstallLog();
    const std::string out = a->out.empty() ? PagePath(a->runs[0]) : a->out;
    const std::vector<RunView> runs =
        WriteReport({a->runs, a->groundtruth, out, "--out", {}, !a->no_images, ""});
    console.Say("wrote " + out);
    if (a->json) PrintWritten(RunsJson(runs), {out});
    return 0;
  };
}

}  // namespace sslcd::apps
