// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench_tables.h"
#include "commands.h"
#include "examples.h"
#include "threads.h"
#include "written.h"

namespace sslcd::apps {
namespace {

int RunBench(BenchArguments& arguments, const Console& console) {
  if (arguments.threads == 0) arguments.threads = HardwareThreads();
  std::sort(arguments.cases.begin(), arguments.cases.end());
  arguments.cases.erase(std::unique(arguments.cases.begin(), arguments.cases.end()),
                        arguments.cases.end());
  CatchInterrupt();
  try {
    const BenchResults results = RunBenchTables(arguments, console);
    nlohmann::ordered_json tables;
    for (const benchmark::Table& table : results.tables)
      tables[table.key] = nlohmann::ordered_json::parse(ToJson(table));
    if (arguments.json) PrintWritten({{"tables", tables}}, results.paths);
  } catch (const BenchStopped&) {
    console.EndStatus();
    console.Say("interrupted: the same command goes on from here");
    return InterruptCode();
  }
  console.Say("wrote " + arguments.out);
  return 0;
}

void AddTableOptions(CLI::App& command, BenchArguments& a) {
  command
      .add_option("NAME", a.name,
                  "table1, table2, table3, attempts, pr, viewpoint, ablation, or all")
      ->required()
      ->check(CLI::IsMember(
          {"table1", "table2", "table3", "attempts", "pr", "viewpoint", "ablation", "all"}));
  command.add_option("--out", a.out, "folder of results; what is there is not measured again")
      ->capture_default_str();
  command.add_option("--seeds", a.seeds, "so many worlds of each case")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_option("--cases", a.cases, "cases of HALV-sim")
      ->check(CLI::Range(1, 4))
      ->delimiter(',');
  command
      .add_option("--viewpoints", a.viewpoints,
                  "viewpoint: besides the cases, small loops that meet themselves at these "
                  "angles, LOW-HIGH [deg]; "
                  "they run whatever --cases is")
      ->delimiter(',')
      ->capture_default_str();
  command.add_option("--methods", a.methods, "methods of table2, pr and viewpoint; default: all")
      ->delimiter(',');
  command.add_option("--baselines", a.baselines,
                     "parameters of the other methods, see config/baselines.yaml");
  command.add_option(
      "--docs", a.docs,
      "Markdown document to put the tables into, between <!-- bench NAME --> and <!-- /bench -->");
}

// The inputs of tables besides HALV-sim.
void AddInputOptions(CLI::App& command, BenchArguments& a) {
  command
      .add_option("--images", a.images,
                  "folder of rendered sequences, lot-c1-s1 for case 1, seed 1, and so on "
                  "(sslcd_sim halv --render); "
                  "the appearance baseline, for table2, pr and viewpoint; "
                  "the latter's worlds are called lot-v45-60-c4-s1 and so on")
      ->check(CLI::ExistingDirectory);
  command
      .add_option(
          "--matches", a.matches,
          "folder with matched image points (SuperGlue's, say), lot-c1-s1.txt for case 1, seed 1, "
          "and so on: "
          "rows of query_frame match_frame confidence; a row of pr and a column of viewpoint")
      ->check(CLI::ExistingDirectory);
  command.add_option("--trajectories", a.trajectories,
                     "NAME=FOLDER: what another system has made of the same sequences, TUM rows "
                     "in FOLDER/lot-c1-s1.txt "
                     "for case 1, seed 1, and so on; a row of table2");
  command
      .add_option("--layout", a.layout, "JSON file of parked cars, for attempts on a real car park")
      ->check(CLI::ExistingFile);
  command
      .add_option(
          "--kitti", a.kitti,
          "KITTI's tracking benchmark with orbslam3_poses and folders of detections, for table1")
      ->check(CLI::ExistingDirectory);
  command
      .add_option("--detections", a.detections,
                  "folders of detections in it; default: det_stereo_grade_car and "
                  "det_pointrcnn_car, if there")
      ->delimiter(',');
}

}  // namespace

Command AddBenchCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand(
      "bench", "the paper's tables and curves: sslcd, the paper and other methods");
  const auto a = std::make_shared<BenchArguments>();
  AddTableOptions(*command, *a);
  AddInputOptions(*command, *a);
  AddThreads(*command, a->threads, 0,
             "runs at a time; the figures but times do not depend on it; 0: all cores");
  command->add_option("--report", a->report,
                      "page to write, with these tables and curves; any browser opens it offline");
  command->add_flag("--json", a->json, "print the tables as JSON and nothing else");
  command->add_flag("-q,--quiet", console.quiet, "print errors only");
  command->footer(Examples({"bench table2 --seeds 2 --cases 1,2 --methods sslcd,paper",
                            "bench pr --report pr.html",
                            "bench viewpoint --viewpoints 150-180 --out runs/viewpoint"}));
  return [a, &console] {
    if (a->json) console.quiet = true;
    console.InstallLog();
    return RunBench(*a, console);
  };
}

}  // namespace sslcd::apps
