// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "datasets/run_folder.h"
#include "evaluation.h"
#include "examples.h"
#include "report/report_page.h"
#include "report_file.h"
#include "sslcd/core/error.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/formats/poses.h"

namespace sslcd::apps {
namespace {

struct EvalArguments {
  std::string run, groundtruth, labels, detections, report;
  bool no_images = false, json = false;
};

int Eval(const EvalArguments& a, const Console& console) {
  CheckRunFolder(a.run);
  PageRequest page{
      {a.run}, a.groundtruth, a.report, "--report", {a.labels, a.detections}, !a.no_images, ""};
  if (!a.report.empty()) {
    RequireReportLibraries();
    RefusePage(page);  // before the comparison, not after it
  }
  EvaluationInput input;
  input.estimate = ReadTrajectory(a.run + "/trajectory_tum.txt");
  input.odometry = ReadTrajectory(a.run + "/odometry_tum.txt");
  if (!a.groundtruth.empty()) {
    const PoseFile truth = ReadPoseFile(a.groundtruth);
    if (truth.trajectory.poses.empty())
      throw Error(ErrorKind::kBadInput, {a.groundtruth}, "has no poses: name the true trajectory");
    input.groundtruth = truth.trajectory;
    input.groundtruth_has_stamps = truth.format != PoseFormat::kKitti;
  }
  MapFile map;
  std::vector<Frame> frames;
  if (!a.labels.empty()) {
    map = ReadMapJson(a.run + "/map.json");
    for (const auto& [index, detections] : ReadDetections(a.detections).by_frame) {
      Frame frame;
      frame.index = index;
      frame.detections = detections;
      frames.push_back(std::move(frame));
    }
    input.map = &map;
    input.detections = &frames;
    input.labels_path = a.labels;
  }
  const Metrics metrics = Evaluate(input);
  page.metrics = MetricsJson(metrics);
  if (!a.report.empty()) WriteReport(page);
  if (a.json) {
    std::fputs(page.metrics.c_str(), stdout);
    return 0;
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, value] : metrics)
    rows.push_back({name, value ? Number("%.4f", *value) : "-"});
  console.Say(AlignedTable(rows));
  if (!a.report.empty()) console.Say("wrote " + a.report);
  return 0;
}

}  // namespace

Command AddEvalCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand("eval", "compare a finished run with ground truth");
  const auto arguments = std::make_shared<EvalArguments>();
  command->add_option("RUN", arguments->run, "folder written by 'sslcd_run run'")->required();
  command
      ->add_option("--groundtruth", arguments->groundtruth,
                   "true poses: TUM, KITTI rows or VINS csv")
      ->required();
  CLI::Option* labels = command->add_option("--labels", arguments->labels,
                                            "KITTI tracking label_02 file: judges the map too");
  CLI::Option* detections = command->add_option("--detections", arguments->detections,
                                                "the detections that the run was made from");
  labels->needs(detections);
  detections->needs(labels);
  CLI::Option* report = command->add_option(
      "--report", arguments->report, "and a page with this comparison, see 'sslcd_run report'");
  command->add_flag("--no-images", arguments->no_images, "no crops of the run's images in the page")
      ->needs(report);
  command->add_flag("--json", arguments->json, "print JSON");
  command->footer(Examples({"eval runs/monday --groundtruth my_sequence/groundtruth.txt",
                            "eval runs/monday --groundtruth my_sequence/groundtruth.txt --json",
                            "eval runs/monday --groundtruth gps.txt --report monday.html"}));
  return [arguments, &console] {
    console.InstallLog();
    return Eval(*arguments, console);
  };
}

}  // namespace sslcd::apps
