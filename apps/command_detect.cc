// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "check_dataset.h"
#include "commands.h"
#include "datasets/sequence_writer.h"
#include "examples.h"
#include "from_images.h"
#include "image_loader.h"
#include "overlay.h"
#include "overwriting.h"
#include "progress.h"
#include "sslcd/config/config.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"
#include "threads.h"

namespace sslcd::apps {
namespace {

namespace fs = std::filesystem;

struct DetectArguments {
  DatasetRequest request;
  std::string out;
  ConfigArguments config;
  ImageArguments images;
  bool force = false, overlays = false, no_check = false, json = false;
  int threads = HardwareThreads();
};

void AddOptions(CLI::App& command, DetectArguments& a) {
  command
      .add_option("DATASET", a.request.path,
                  "folder with image_2, image_3 (or image_0, image_1) and calib.txt")
      ->required();
  command.add_option("--format", a.request.format, "layout of the folder; guessed where not given")
      ->check(CLI::IsMember(DatasetFormatNames()));
  command.add_option("--sequence", a.request.sequence, "which sequence of the dataset, e.g. 0007");
  command.add_option(
      "--odometry", a.request.odometry,
      "poses to go with the detections; or 'stereo': from the images, as where there is no file; "
      "that, without a detector or boxes, makes odometry alone");
  a.images.AddTo(command);
  a.config.AddTo(command);
  command.add_option("--out", a.out, "folder to write: a sequence for sslcd_run run")->required();
  command.add_flag("--force", a.force, "write into a folder that is not empty");
  command.add_flag("--overlays", a.overlays,
                   "and OUT/overlays: the left images with boxes and cuboids");
  command.add_option("--max-frames", a.request.max_frames, "stop after so many frames")
      ->check(CLI::PositiveNumber);
  command.add_flag("--no-check", a.no_check,
                   "do not test the dataset for mistakes (sslcd_run check)");
  AddThreads(command, a.threads);
}

// A cue whose file must be complete has no file if some of the detections have no vector.
void WarnOfIncompleteCues(const std::vector<std::vector<Detection>>& detections) {
  for (const CueRow& cue : kCueRows) {
    int with = 0, without = 0;
    for (const auto& frame : detections)
      for (const Detection& detection : frame)
        ++(detection.appearance[cue.cue].empty() ? without : with);
    if (cue.complete && with > 0 && without > 0)
      Log(LogLevel::kWarning, std::to_string(without) + " of " + std::to_string(with + without) +
                                  " detections have no " + cue.name +
                                  " (grey images, or boxes outside of the image): no " + cue.file);
  }
}

// The output has the same file names as the input.
void RefuseInput(const fs::path& out, const Dataset& dataset) {
  std::vector<fs::path> inputs = {dataset.odometry_path, dataset.groundtruth_path};
  for (const Frame& frame : dataset.frames)
    if (!frame.image_left.empty()) inputs.push_back(fs::path(frame.image_left).parent_path());
  std::error_code none;
  for (const fs::path& input : inputs)
    if (!input.empty() && fs::equivalent(out, input.parent_path(), none))
      throw Error(
          ErrorKind::kUsage,
          out.string() + ": holds images, odometry or ground truth that are read; write elsewhere");
}

// All parts of the sequence except the frames.
SequenceFiles SequenceFilesOf(const Dataset& dataset) {
  SequenceFiles files;
  if (dataset.camera && dataset.camera_right) files.camera = StereoCameraOf(dataset);
  files.up_axis = dataset.up_axis;
  files.labels = dataset.labels;
  files.groundtruth = dataset.groundtruth;
  return files;
}

bool MakesOdometryAlone(const DetectArguments& a, const VisionOptions& vision) {
  return a.request.odometry == "stereo" && !a.images.detects() && a.images.embedder.empty() &&
         vision.detector.empty();
}

Dataset LoadWithoutDetections(DatasetRequest& request) {
  request.detections_policy = PartPolicy::kIgnored;
  ChooseOdometry(request);
  Dataset dataset = LoadDataset(request);
  for (const std::string& warning : dataset.warnings) Log(LogLevel::kWarning, warning);
  return dataset;
}

// Throws Error(kUsage) if the output would replace an input or leave a ground truth of other
// frames.
void CheckOutput(const DetectArguments& a, const Dataset& dataset) {
  const fs::path out = a.out;
  RefuseInput(out, dataset);
  if (a.force && !dataset.groundtruth && fs::exists(out / "groundtruth.txt"))
    throw Error(
        ErrorKind::kUsage,
        (out / "groundtruth.txt").string() +
            ": would be of other frames, and the dataset has none to put in its place; move it");
  RefuseOverwriting({a.images.boxes, a.config.file},
                    {(out / "detections.txt").string(), (out / "config.yaml").string()});
}

// Appends frames to `files` until the end, ctrl-C or an error. Returns the error, so that earlier
// frames are kept.
std::optional<Error> CollectFrames(ImageFrontend& frontend, int total, const Console& console,
                                   SequenceFiles& files) {
  std::optional<Error> failure;
  Progress progress(console, "frame");
  CatchInterrupt();
  while (!Interrupted()) {
    std::optional<Frame> frame = NextFrame(frontend, files.detections.size(), failure);
    if (!frame) break;
    files.odometry.stamps.push_back(frame->stamp);
    files.odometry.poses.push_back(frame->T_odom_cam);
    files.detections.push_back(std::move(frame->detections));
    progress.Report(static_cast<int>(files.detections.size()), total);
  }
  console.EndStatus();
  return failure;
}

// The configuration for mapping the written sequence.
std::string ResolvedConfig(Configuration configuration, const ImageRequest& request) {
  if (MeasuresByStereo(request, configuration.vision))
    configuration.vision.odometry.calibrate = false;  // calib.txt has what CheckRig found
  return DumpConfig([&](FieldVisitor& v) { DescribeFields(v, configuration); }, false);
}

// Prints the output and the command that maps it.
std::string Written(const std::string& out, bool odometry_alone) {
  return "wrote " + out +
         (odometry_alone ? "; map it with detections: sslcd_run run "
                         : "; map it with: sslcd_run run ") +
         out + " --config " + (fs::path(out) / "config.yaml").string() +
         (odometry_alone ? " --detections FILE" : "");
}

int Detect(DetectArguments& a, const Console& console) {
  a.images.AddTo(a.config);
  const Configuration given = a.config.Load();  // reports wrong options first
  a.config.RefuseCodeFrom(a.request.path);
  const bool odometry_alone = MakesOdometryAlone(a, given.vision);
  if (odometry_alone && a.overlays)
    throw Error(ErrorKind::kUsage,
                "--overlays show detections: name a detector (--detector) or boxes (--boxes), or "
                "leave it out");
  Dataset dataset = LoadWithoutDetections(a.request);
  if (!a.no_check) WarnOfMistakes(a.request, dataset);
  CheckOutput(a, dataset);
  const fs::path out = a.out;
  const FileLock lock = PrepareSequenceFolder(out, a.force);
  const bool fresh = IsEmptyFolder(a.out);
  const ImageRequest request = a.images.RequestFor(dataset, !odometry_alone, given);
  const Configuration configuration = AdaptToImages(a.config, given, request, dataset, console);

  const Camera camera = dataset.camera.value_or(Camera());
  Overlays overlays(out / "overlays");
  std::function<void(const Frame&, const ImageView&)> watch;
  if (a.overlays)
    watch = [&](const Frame& frame, const ImageView& left) { overlays.Write(frame, left, camera); };
  ImageFrontend frontend(MakeImageSequence(request, dataset), configuration.vision,
                         configuration.options.colour, {LoadImage, watch}, a.threads);
  frontend.AddLabels(dataset.labels);
  if (request.odometry)
    console.Say(odometry_alone ? "odometry: made from the images; no detections"
                               : "odometry: made from the images");

  SequenceFiles files = SequenceFilesOf(dataset);
  const std::optional<Error> failure =
      CollectFrames(frontend, static_cast<int>(dataset.frames.size()), console, files);
  const FrontendReport report = frontend.Finish();
  if (Interrupted()) {
    Log(LogLevel::kWarning, "interrupted: nothing but overlays is written");
    return InterruptCode();
  }
  if (failure && !fresh) {
    Log(LogLevel::kWarning,
        "stopped by an error: but for overlays " + a.out +
            " holds what it held before; choose a new folder to keep the frames before the error");
    throw *failure;
  }
  WarnOfIncompleteCues(files.detections);
  files.config_yaml = ResolvedConfig(configuration, request);
  WriteSequenceFiles(out, files);
  overlays.RemoveOthers();
  WarnOfFrontend(report);
  if (a.json) std::fputs(FrontendJson(report).c_str(), stdout);
  console.Say(FrontendTable(report) + "\n\n" + TimingText(report.timing) + "\n\n" +
              Written(a.out, odometry_alone));
  if (failure) {
    Log(LogLevel::kWarning, "stopped by an error: " + a.out + " holds the frames before it (" +
                                std::to_string(files.detections.size()) + ")");
    throw *failure;
  }
  return 0;
}

}  // namespace

Command AddDetectCommand(CLI::App& app, Console& console) {
  CLI::App* command =
      app.add_subcommand("detect", "make detections, embeddings and odometry from stereo images");
  const auto arguments = std::make_shared<DetectArguments>();
  AddOptions(*command, *arguments);
  command->add_flag("-q,--quiet", console.quiet, "print errors only");
  command->add_flag("-v,--verbose", console.verbose, "print more");
  command->add_flag("--json", arguments->json, "print the counts as JSON and nothing else");
  command->footer(Examples({"detect my_images --detector yolo11.yaml --out found",
                            "detect my_images --boxes boxes.txt --overlays --out found",
                            "detect my_images --odometry stereo --out odometry"}));
  return [arguments, &console] {
    if (arguments->json) console.quiet = true;
    console.InstallLog();
    return Detect(*arguments, console);
  };
}

}  // namespace sslcd::apps
