// SPDX-License-Identifier: BSD-3-Clause
#include "from_images.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "console.h"
#include "image_loader.h"
#include "sslcd/core/for_each.h"
#include "sslcd/core/log.h"
#include "sslcd/core/median.h"
#include "sslcd/detectors/model_description.h"
#include "sslcd/io/boxes_reader.h"
#include "sslcd/stereo/ground_alignment.h"
#include "stereo_files.h"

namespace sslcd::apps {
namespace {

void WarnOfGround(const GroundReport& ground) {
  if (2 * ground.elsewhere <= ground.frames) return;
  std::string message =
      "the ground is not where vision.lift.ground has it in " + std::to_string(ground.elsewhere) +
      " of " + std::to_string(ground.frames) +
      " frames looked at, so cuboids are poor: set vision.lift.ground.height_m to the height of "
      "the camera over the ground";
  if (!ground.heights_m.empty())
    message += "; that seems to be " + Number("%.2f", Median(ground.heights_m)) + " m";
  Log(LogLevel::kWarning, message);
}

/// Whether 2D boxes are lifted by stereo images. (3D detectors bring the depth.)
bool LiftsBoxes(const ImageArguments& arguments, const VisionOptions& vision) {
  if (!arguments.boxes.empty()) return true;
  return !vision.detector.empty() &&
         TaskOf(LoadModelDescription(vision.detector).output.layout) == ModelTask::kDetect2d;
}

/// AlignGround of two frames, read from their files. None: they cannot be aligned; `problem` says
/// what is wrong with the images.
std::optional<RelativePose> Align(const ViewPair& pair, const StereoFiles& files,
                                  const StereoCamera& camera, const VisionOptions& vision,
                                  std::string& problem) {
  const auto& a = files[pair.a_frame];
  const auto& b = files[pair.b_frame];
  Image images[4];
  const std::string* const paths[] = {&a.first, &a.second, &b.first, &b.second};
  const auto complain = [&](const std::string& file, const std::string& what) {
    problem = file + ": not aligned with images of other passes: " + what;
    return std::nullopt;
  };
  for (int i = 0; i < 4; ++i) {
    if (Interrupted() || paths[i]->empty()) return std::nullopt;
    images[i] = LoadImage(*paths[i]);
    if (images[i].empty()) return complain(*paths[i], "it cannot be read");
  }
  try {
    return AlignGround({images[0].view(), images[1].view()}, {images[2].view(), images[3].view()},
                       camera, pair.T_a_b_guess, vision.lift.ground, vision.alignment);
  } catch (const Error& error) {  // others may do
    return complain(a.first + ", " + b.first, error.what());
  }
}

}  // namespace

void ImageArguments::AddTo(CLI::App& command) {
  command.add_option(
      "--boxes", boxes,
      "make detections from 2D boxes: rows 'frame label score left top right bottom'");
  command
      .add_option("--detector", detector,
                  "... or from the images alone: YAML description of a 2D or 3D detector")
      ->excludes("--boxes");
  command.add_option("--embedder", embedder, "YAML description of a re-identification model");
}

Configuration ImageArguments::Load(ConfigArguments config, Dataset& dataset,
                                   bool detections) const {
  if (!detector.empty()) config.settings.push_back("vision.detector=" + detector);
  if (!embedder.empty()) config.settings.push_back("vision.embedder=" + embedder);
  const Configuration given = config.Load();
  const VisionOptions& vision = given.vision;
  if (detections && boxes.empty()) config.CheckPath(vision.detector);
  if (detections) config.CheckPath(vision.embedder);
  // A detector that is not used need not be there: `detect` names its own in the configuration of
  // what it has made.
  const bool lifted = detections && LiftsBoxes(*this, vision),
             tracked = dataset.odometry_path.empty();
  const bool no_objects = !dataset.detections_path.empty() && dataset.rows_read == 0;
  const StereoFiles files = StereoFilesOf(dataset);
  std::optional<double> row_error_rad, spot_ahead;
  if (MeasuresByStereo(vision, dataset, detections) && dataset.camera && dataset.camera_right) {
    const RigCheck check = CheckRigOf(files, StereoCameraOf(dataset), vision.odometry);
    dataset.camera_right->cx = dataset.camera->cx - check.disparity_at_infinity;
    if (check.row_error) row_error_rad = *check.row_error / dataset.camera->fy;
  }
  if (given.options.loop.views.enabled && dataset.camera && dataset.camera_right)
    spot_ahead = SpotAheadOf(files, *dataset.camera, vision.lift.ground.height_m);
  if (spot_ahead)
    Log(LogLevel::kInfo, "ground of different passes is compared " + Number("%.1f", *spot_ahead) +
                             " m ahead of the cameras, unless loop.views.ahead_m says otherwise");
  return config.Load([&](Configuration& c) {
    if (spot_ahead) c.options.loop.views.ahead_m = *spot_ahead;
    if (lifted)
      c.options.noise = LiftNoise(), c.options.ba.loss_scale = 1, c.options.ba.correlation = 4;
    if (!tracked) return;
    c.options.loop.odometry = c.options.ba.odometry = StereoOdometryNoise(row_error_rad);
    if (lifted || no_objects)
      c.options.ba.odometry.scale_prior = c.options.loop.odometry.scale_prior = 0;
  });
}

bool ImageArguments::MeasuresByStereo(const VisionOptions& vision, const Dataset& dataset,
                                      bool detections) const {
  return dataset.odometry_path.empty() || (detections && LiftsBoxes(*this, vision));
}

std::optional<ImageFrontend> ImageArguments::Make(
    Dataset& dataset, const Configuration& configuration, bool detections, int threads,
    std::function<void(const Frame&, const ImageView&)> watch) const {
  ImageSequence sequence;
  sequence.odometry = dataset.odometry_path.empty();
  sequence.detections = detections;
  if (!sequence.odometry && !detections) return std::nullopt;
  if (!dataset.camera || !dataset.camera_right)
    throw Error(ErrorKind::kBadInput, {dataset.name},
                "needs calib.txt (raw drives: calib_cam_to_cam.txt) with P2 and P3, of grey images "
                "P0 and P1, to make "
                "anything from its images");
  sequence.camera = StereoCameraOf(dataset);
  if (detections && !boxes.empty()) {
    sequence.boxes = ReadBoxes(boxes);
    const auto beyond = sequence.boxes->lower_bound(static_cast<int>(dataset.frames.size()));
    const auto count = std::distance(beyond, sequence.boxes->end());
    if (count > 0)
      Log(LogLevel::kWarning,
          boxes + ": has boxes of " + std::to_string(count) + " frames after the last one (" +
              std::to_string(dataset.frames.size() - 1) + "); they are left out");
  }
  sequence.frames = std::move(dataset.frames);
  ImageFrontend frontend(std::move(sequence), configuration.vision, configuration.options.colour,
                         {LoadImage, std::move(watch)}, threads);
  frontend.AddLabels(dataset.labels);
  return frontend;
}

ViewAligner ImageArguments::MakeAligner(const Dataset& dataset, const Configuration& configuration,
                                        int threads,
                                        std::function<void(int done, int total)> progress) const {
  const StereoFiles files = StereoFilesOf(dataset);
  const bool any_pair = std::any_of(files.begin(), files.end(), [](const auto& pair) {
    return !pair.first.empty() && !pair.second.empty();
  });
  if (!any_pair || !dataset.camera || !dataset.camera_right ||
      !configuration.options.loop.views.enabled)
    return {};
  StereoCamera camera;
  try {
    camera = StereoCameraOf(dataset);
  } catch (const Error& error) {  // who maps given detections needs no pair
    Log(LogLevel::kWarning,
        std::string("images of different passes are not aligned: ") + error.what());
    return {};
  }
  const VisionOptions vision = configuration.vision;
  const bool check = vision.odometry.calibrate && !MeasuresByStereo(vision, dataset, detects());
  return [=, progress = std::move(progress)](const std::vector<ViewPair>& pairs) {
    std::vector<std::optional<RelativePose>> answers(pairs.size());
    std::vector<std::string> problems(pairs.size());
    try {
      StereoCamera used = camera;
      if (check)
        used.disparity_at_infinity =
            CheckRigOf(files, camera, vision.odometry).disparity_at_infinity;
      ForEach(
          pairs.size(), threads,
          [&](std::size_t i) { answers[i] = Align(pairs[i], files, used, vision, problems[i]); },
          progress);
    } catch (const Error& error) {  // the run before this is not lost
      problems.push_back(std::string("images of different passes are not aligned: ") +
                         error.what());
    }
    // What is wrong with the images is said once: it may be wrong with all of them.
    const auto first = std::find_if(problems.begin(), problems.end(),
                                    [](const std::string& p) { return !p.empty(); });
    if (first != problems.end()) Log(LogLevel::kWarning, *first);
    return answers;
  };
}

std::optional<Frame> NextFrame(ImageFrontend& frontend, std::size_t done,
                               std::optional<Error>& failure) {
  try {
    return frontend.Next();
  } catch (const Error& error) {
    if (done == 0 || error.kind() == ErrorKind::kNoSolution) throw;
    failure = error;
    return std::nullopt;
  }
}

void ChooseOdometry(DatasetRequest& request) {
  request.odometry_policy = PartPolicy::kIfThere;
  if (request.odometry != "stereo") return;
  request.odometry.clear();
  request.odometry_policy = PartPolicy::kIgnored;
}

std::string FrontendTable(const FrontendReport& report) {
  std::string unknown;
  for (const std::string& label : report.unknown) unknown += " " + label;
  if (!unknown.empty())
    Log(LogLevel::kWarning,
        "boxes that no sizes are known for are not lifted:" + unknown +
            "; map them to known labels (docs/models.md), which vision.lift.classes lists");
  WarnOfGround(report.ground);
  std::vector<std::vector<std::string>> rows = {
      {"frames read", std::to_string(report.frames)},
      {"without images", std::to_string(report.images_failed)},
      {"odometry guessed", std::to_string(report.lost)}};
  for (const auto& [status, count] : report.lift)
    rows.push_back({std::string("boxes ") + ToString(status), std::to_string(count)});
  rows.push_back({"detections", std::to_string(report.detections)});
  return AlignedTable(rows);
}

}  // namespace sslcd::apps
