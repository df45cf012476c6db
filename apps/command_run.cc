// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "check/report_text.h"
#include "check_dataset.h"
#include "commands.h"
#include "datasets/run_folder.h"
#include "eval/kitti_ground_truth.h"
#include "evaluation.h"
#include "examples.h"
#include "formats/file_lock.h"
#include "formats/files.h"
#include "from_images.h"
#include "image_loader.h"
#include "loop_lines.h"
#include "map_run.h"
#include "overwriting.h"
#include "progress.h"
#include "report/report_page.h"
#include "report_file.h"
#include "run_record.h"
#include "run_tables.h"
#include "sslcd/config/config.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/pipeline/run.h"
#include "threads.h"

namespace sslcd::apps {
namespace {

constexpr const char* kLatest = "runs/latest";  // holds whatever run was the last

struct RunArguments {
  DatasetRequest request;
  std::string score = "auto", out;
  ConfigArguments config;
  ImageArguments images;
  MapArguments map;
  bool no_check = false, json = false, force = false, report = false, no_images = false;
  int threads = HardwareThreads();
};

void AddOptions(CLI::App& command, RunArguments& a) {
  command.add_option("DATASET", a.request.path, "dataset folder")->required();
  command.add_option("--format", a.request.format, "layout of the folder; guessed where not given")
      ->check(CLI::IsMember(DatasetFormatNames()));
  command.add_option("--sequence", a.request.sequence, "which sequence of the dataset, e.g. 0007");
  command.add_option("--detections", a.request.detections,
                     "file or folder, relative to DATASET or the current folder");
  command.add_option("--odometry", a.request.odometry,
                     "poses, likewise; or 'stereo': from the images, as where there is no file");
  a.images.AddTo(command);
  command.add_option("--groundtruth", a.request.groundtruth,
                     "poses, likewise; for the metrics only");
  command.add_option("--score", a.score, "what the score column holds; guessed where not given")
      ->check(CLI::IsMember({"auto", "probability", "logit"}));
  a.config.AddTo(command);
  a.map.AddTo(command);
  command.add_option("--out", a.out, "folder to write; default runs/latest, with --map none")
      ->default_str(kLatest);
  command.add_flag("--force", a.force, "write into a folder that holds another run");
  CLI::Option* report =
      command.add_flag("--report", a.report, "and OUT/report.html, see 'sslcd_run report'");
  command.add_flag("--no-images", a.no_images, "no crops of the images in OUT/report.html")
      ->needs(report);
  command.add_option("--max-frames", a.request.max_frames, "stop after so many frames")
      ->check(CLI::PositiveNumber);
  command.add_flag("--no-check", a.no_check,
                   "do not test the dataset for mistakes (sslcd_run check)");
  AddThreads(command, a.threads);
  command.add_flag("--json", a.json, "print the metrics as JSON and nothing else");
}

struct Input {
  Dataset dataset;
  std::optional<std::vector<CheckRecord>> check;  // none: not tested
};

Input Load(RunArguments& a, const Console& console) {
  ChooseOdometry(a.request);
  if (!a.images.embedder.empty() && !a.images.detects())
    throw Error(ErrorKind::kUsage,
                "--embedder goes with detections made from images: add --detector or --boxes");
  if (a.images.detects() && !a.request.detections.empty())
    throw Error(ErrorKind::kUsage,
                "--detections names detections, --detector and --boxes make others: choose one");
  if (a.images.detects()) a.request.detections_policy = PartPolicy::kIgnored;
  a.request.detection_options.score = a.score == "auto"          ? ScoreKind::kAuto
                                      : a.score == "probability" ? ScoreKind::kProbability
                                                                 : ScoreKind::kLogit;
  Input input{LoadDataset(a.request), {}};
  const Dataset& dataset = input.dataset;
  for (const std::string& warning : dataset.warnings) Log(LogLevel::kWarning, warning);
  if (!a.no_check) input.check = check::Records(WarnOfMistakes(a.request, dataset));
  std::string line = dataset.name + ": " + dataset.format +
                     (a.request.format == "auto" ? " (guessed), " : ", ") +
                     std::to_string(dataset.frames.size()) + " frames, " +
                     std::to_string(dataset.rows_read) + " detections";
  if (dataset.rows_dropped > 0)
    line += ", " + std::to_string(dataset.rows_dropped) + " of them dropped as invalid";
  console.Say(line);
  if (dataset.rows_read == 0 && !a.images.detects())
    Log(LogLevel::kWarning,
        "no detections: the map will be empty, and nothing but images that can be aligned corrects "
        "the odometry");
  return input;
}

// The file of the true identities. Empty if there is none, or no ground-truth poses.
std::string IdentitiesPath(const RunArguments& a, const Dataset& dataset) {
  const std::filesystem::path detections(dataset.detections_path),
      path = detections.parent_path() / "landmark_ids.txt";
  const bool others = !a.request.detections.empty() && detections.filename() != "detections.txt";
  return !dataset.groundtruth || detections.empty() || others ? "" : IfFile(path);
}

// The true identity of each detection row. Empty if they are unknown.
std::vector<int> IdentitiesOf(const std::string& path, const Dataset& dataset) {
  if (path.empty()) return {};
  std::vector<int> identities = ReadLandmarkIds(path);
  if (identities.size() == static_cast<std::size_t>(dataset.rows_read)) return identities;
  Log(LogLevel::kWarning, path + ": has " + std::to_string(identities.size()) +
                              " rows, but there are " + std::to_string(dataset.rows_read) +
                              " detections: loops are not judged");
  return {};
}

struct Mapped {
  RunResult result;
  // the input frames: from the dataset, or completed by the frontend
  std::vector<Frame> frames;
  std::optional<Error> failure;  // the error that ended the run early; earlier frames are kept
};

// Makes the odometry or detections that the dataset lacks and then takes the frames out of
// `dataset`. None: nothing is lacking.
std::optional<ImageFrontend> MakeFrontend(const ImageRequest& request, Dataset& dataset,
                                          const Configuration& configuration, int threads) {
  if (!request.odometry && !request.detections) return std::nullopt;
  ImageFrontend frontend(MakeImageSequence(request, dataset), configuration.vision,
                         configuration.options.colour, {LoadImage}, threads);
  frontend.AddLabels(dataset.labels);
  return frontend;
}

Mapped MapFrames(const RunArguments& a, const ImageRequest& request, Dataset& dataset,
                 const Configuration& configuration, const Console& console) {
  const int total = static_cast<int>(dataset.frames.size());
  Progress views(console, "view"), frames(console, "frame");
  LoopLines lines(console);
  const auto view_progress = [&views](int done, int count) { views.Report(done, count); };
  const ViewAligner aligner = MakeGroundAligner(
      request, dataset, configuration.vision, FilesOf(dataset), {false, a.threads, view_progress});
  std::optional<ImageFrontend> frontend = MakeFrontend(request, dataset, configuration, a.threads);
  if (request.odometry) console.Say("odometry: made from the images");
  const MapperContext context{
      GravityFrame::FromUp(dataset.up_axis), dataset.labels, dataset.camera, {}, aligner};
  RunHooks hooks;
  hooks.progress = [&](int done, int count) {
    frames.Report(done, count);
    if (done == count) console.Status("refining the map");
  };
  hooks.loops = [&lines](const std::vector<LoopClosure>& changed) { lines.Report(changed); };
  hooks.stop = [] { return Interrupted(); };
  // the frontend has measured the colours of its own detections
  if (!a.images.detects()) hooks.with_image = WithImage;
  CatchInterrupt();
  Mapped mapped;
  const auto next = [&]() -> std::optional<Frame> {
    std::optional<Frame> frame;
    if (frontend)
      frame = NextFrame(*frontend, mapped.frames.size(), mapped.failure);
    else if (mapped.frames.size() < dataset.frames.size())
      frame = dataset.frames[mapped.frames.size()];
    if (frame) mapped.frames.push_back(*frame);
    return frame;
  };
  if (a.map.given()) {
    const auto failed = [&mapped] { return mapped.failure.has_value(); };
    mapped.result = RunInMap(a.map, {dataset.name, a.request.path, next, total, failed, lines},
                             context, configuration.options, hooks);
  } else {
    mapped.result = RunSequence(next, total, context, configuration.options, hooks);
    mapped.result.stopped = Interrupted();  // may have happened during view alignment
  }
  if (!frontend) {
    mapped.frames = std::move(dataset.frames);
    console.EndStatus();
    return mapped;
  }
  const FrontendReport report = frontend->Finish();
  mapped.result.timing.Append(report.timing);
  console.EndStatus();
  WarnOfFrontend(report);
  console.Say(FrontendTable(report) + "\n");
  return mapped;
}

RunOutputs OutputsOf(const RunResult& result, const Dataset& dataset, Configuration configuration) {
  RunOutputs outputs;
  outputs.trajectory = result.trajectory;
  outputs.odometry = result.odometry;
  if (dataset.groundtruth) outputs.groundtruth = *dataset.groundtruth;
  outputs.map = {dataset.up_axis, result.objects};
  outputs.graph = result.graph;
  outputs.loops = result.loops;
  outputs.timing = result.timing;
  outputs.config_yaml =
      DumpConfig([&](FieldVisitor& v) { DescribeFields(v, configuration); }, false);
  return outputs;
}

Metrics EvaluateRun(const RunArguments& a, const Dataset& dataset, std::vector<int> identities,
                    const Mapped& mapped, const RunOutputs& outputs) {
  if (mapped.result.frames.empty()) return {};
  EvaluationInput evaluation;
  evaluation.estimate = mapped.result.trajectory;
  evaluation.frames = mapped.result.frames;
  evaluation.groundtruth = dataset.groundtruth;
  evaluation.odometry = mapped.result.odometry;
  evaluation.map = &outputs.map;
  evaluation.detections = &mapped.frames;
  evaluation.labels_path = dataset.groundtruth_boxes_path;
  evaluation.identities = std::move(identities);
  evaluation.loops = mapped.result.loops;
  try {
    return Evaluate(evaluation);
  } catch (const Error& error) {  // e.g. interrupted before the first true pose: keep the run
    if (error.kind() != ErrorKind::kNoSolution) throw;
    Log(LogLevel::kWarning, std::string("no metrics: ") + error.what());
    return {};
  }
}

RunRecord RecordOfRun(const RunArguments& a, const Dataset& dataset, const Mapped& mapped,
                      const Console& console) {
  RunRecord record = RecordRun(dataset,
                               {{"identities", IdentitiesPath(a, dataset)},
                                {"configuration", a.config.file},
                                {"2D boxes", a.images.boxes},
                                {"detector", a.images.detector},
                                {"embedder", a.images.embedder}},
                               console);
  const RunResult& result = mapped.result;
  record.complete = !result.stopped && !mapped.failure;
  record.counts = {{"frames", result.frames.size()},
                   {"detections_used", result.filter.kept},
                   {"detections_dropped", result.filter.dropped()},
                   {"landmarks", Landmarks(result)},
                   {"loops_accepted", LoopsOf(result, LoopDecision::kAccepted)},
                   {"loops_ambiguous", LoopsOf(result, LoopDecision::kAmbiguous)},
                   {"loops_none", LoopsOf(result, LoopDecision::kNone)},
                   {"views_tied", result.views_tied},
                   {"odometry_scale", result.scale}};
  return record;
}

void WarnOfLimits(const Mapped& mapped) {
  if (const int too_many = mapped.result.filter.too_many; too_many > 0)
    Log(LogLevel::kWarning, std::to_string(too_many) +
                                " detections dropped, because a frame has more than "
                                "filter.max_count: raise it if they are real objects");
  if (mapped.failure)
    Log(LogLevel::kWarning, "stopped by an error: the results are those of the frames before");
  else if (mapped.result.stopped)
    Log(LogLevel::kWarning, "interrupted: the results are those of what was done before");
}

// A session that can go on.
int ReportOpenSession(const RunArguments& a, const Mapped& mapped) {
  Log(LogLevel::kWarning, MapLine(a.map) + "; the same command with --resume goes on");
  if (mapped.failure) throw *mapped.failure;
  return InterruptCode();
}

int Run(RunArguments& a, const Console& console) {
  if (a.out.empty() && !a.map.given()) a.out = kLatest;
  a.images.AddTo(a.config);
  const Configuration given = a.config.Load();  // reports wrong options first
  a.config.RefuseCodeFrom(a.request.path);
  std::optional<FileLock> lock;
  if (!a.out.empty()) {
    RefuseFolder(a.request.path, a.out);
    if (a.report) RequireReportLibraries();
    lock.emplace(LockFolder(a.out));  // fails before the run, not after it
    if (!a.force && a.out != kLatest) RefuseOtherRun(a.out);
  }
  Input input = Load(a, console);
  Dataset& dataset = input.dataset;
  std::vector<std::string> written = RunFolderPaths(a.out);
  if (a.report) written.push_back(PagePath(a.out));
  RefuseOverwriting({dataset.odometry_path, dataset.detections_path, dataset.groundtruth_path,
                     a.images.boxes, a.config.file, a.map.file},
                    written);
  std::vector<int> identities = IdentitiesOf(IdentitiesPath(a, dataset), dataset);
  const ImageRequest request = a.images.RequestFor(dataset, a.images.detects(), given);
  Configuration configuration = AdaptToImages(a.config, given, request, dataset, console);
  UseOptionsOfMap(a.map, a.config, configuration);
  const Mapped mapped = MapFrames(a, request, dataset, configuration, console);
  if (a.map.given() && mapped.result.stopped) return ReportOpenSession(a, mapped);
  RunOutputs outputs = OutputsOf(mapped.result, dataset, configuration);
  outputs.metrics = EvaluateRun(a, dataset, std::move(identities), mapped, outputs);
  WarnOfLimits(mapped);
  outputs.record = RecordOfRun(a, dataset, mapped, console);
  outputs.record.check = std::move(input.check);
  std::vector<std::string> paths;
  if (!a.out.empty()) paths = WriteRunFolder(a.out, outputs);
  if (a.report && !a.out.empty()) {
    paths.push_back(PagePath(a.out));
    WriteReport({{a.out}, "", paths.back(), "--out", {}, !a.no_images, ""});
  }

  if (a.json) std::fputs(MetricsJson(outputs.metrics).c_str(), stdout);
  console.Say(ResultTable(mapped.result, outputs.metrics) + "\n");
  if (LoopsOf(mapped.result, LoopDecision::kAccepted) == 0)
    console.Say(NoLoopTable(mapped.result, configuration.options.loop, dataset.up_axis) + "\n");
  console.Say(TimingText(mapped.result.timing) + "\n");
  for (const std::string& path : paths) console.Say("wrote " + path);
  if (a.map.given()) console.Say("wrote " + MapLine(a.map));
  if (mapped.failure) throw *mapped.failure;
  return mapped.result.stopped ? InterruptCode() : 0;
}

}  // namespace

Command AddRunCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand("run", "map a sequence and correct its trajectory");
  const auto arguments = std::make_shared<RunArguments>();
  AddOptions(*command, *arguments);
  command->add_flag("-q,--quiet", console.quiet, "print errors only");
  command->add_flag("-v,--verbose", console.verbose,
                    "print more: each loop that a refinement brings, refused ones too");
  command->footer(Examples({"run my_sequence --out runs/monday",
                            "run kitti/training --sequence 0007 --detections det --odometry poses",
                            "run tuesday --map site.db --set loop.views.guess_m=0.5"}));
  return [arguments, &console] {
    if (arguments->json) console.quiet = true;
    console.InstallLog();
    return Run(*arguments, console);
  };
}

}  // namespace sslcd::apps
