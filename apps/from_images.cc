// SPDX-License-Identifier: BSD-3-Clause
#include "from_images.h"

#include <algorithm>
#include <vector>

#include "console.h"
#include "core/median.h"
#include "formats/metrics_json.h"
#include "image_loader.h"
#include "sslcd/core/log.h"

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

Metrics Counts(const FrontendReport& report) {
  Metrics counts = {{"frames read", report.frames},
                    {"without images", report.images_failed},
                    {"odometry guessed", report.lost}};
  for (const auto& [status, count] : report.lift)
    counts.emplace_back(std::string("boxes ") + ToString(status), count);
  counts.emplace_back("detections", report.detections);
  return counts;
}

}  // namespace

void ImageArguments::AddTo(CLI::App& command) {
  command.add_option(
      "--boxes", boxes,
      "make detections from 2D boxes: rows 'frame label score left top right bottom'");
  command
      .add_option("--detector", detector,
                  "make detections from the images alone: YAML description of a 2D or 3D detector")
      ->excludes("--boxes");
  command.add_option("--embedder", embedder, "YAML description of a re-identification model");
}

void ImageArguments::AddTo(ConfigArguments& config) const {
  if (!detector.empty()) config.settings.push_back("vision.detector=" + detector);
  if (!embedder.empty()) config.settings.push_back("vision.embedder=" + embedder);
}

ImageRequest ImageArguments::RequestFor(const Dataset& dataset, bool detections,
                                        const Configuration& given) const {
  return {dataset.odometry_path.empty(), detections, boxes, given.options.loop.views.enabled};
}

StereoFiles FilesOf(const Dataset& dataset) {
  return StereoFilesOf(dataset.frames, LoadImage, Interrupted);
}

Configuration AdaptToImages(const ConfigArguments& config, const Configuration& given,
                            const ImageRequest& request, Dataset& dataset, const Console& console) {
  // Only models in use are checked: the configuration that `detect` writes names its detector.
  if (request.detections && request.boxes.empty()) config.CheckPath(given.vision.detector);
  if (request.detections) config.CheckPath(given.vision.embedder);
  if (LiftsBoxes(request, given.vision)) config.CheckPath(given.vision.classes);
  const ImageSource source = InspectImages(request, given.vision, FilesOf(dataset), dataset);
  std::vector<std::string> keys;
  const Configuration adapted =
      config.LoadOver(given.mode, [&](Configuration& c) { keys = AdaptTo(source, c.options); });
  std::string line;
  for (const std::string& key : keys) line += (line.empty() ? "" : ", ") + key;
  if (!line.empty())
    console.Say("adapted to the images, where not set by you: " + line + " (values: config.yaml)");
  return adapted;
}

void ChooseOdometry(DatasetRequest& request) {
  request.odometry_policy = PartPolicy::kIfThere;
  if (request.odometry != "stereo") return;
  request.odometry.clear();
  request.odometry_policy = PartPolicy::kIgnored;
}

void WarnOfFrontend(const FrontendReport& report) {
  std::string unknown;
  for (const std::string& label : report.unknown) unknown += " " + label;
  if (!unknown.empty())
    Log(LogLevel::kWarning, "boxes that no sizes are known for are not lifted:" + unknown +
                                "; map them to known labels, or add sizes to a file of classes "
                                "(vision.lift.classes; docs/models.md)");
  WarnOfGround(report.ground);
}

std::string FrontendTable(const FrontendReport& report) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, count] : Counts(report)) rows.push_back({name, Number("%.0f", *count)});
  return AlignedTable(rows);
}

std::string FrontendJson(const FrontendReport& report) {
  Metrics counts = Counts(report);
  for (auto& [name, count] : counts) std::replace(name.begin(), name.end(), ' ', '_');
  return MetricsJson(counts);
}

}  // namespace sslcd::apps
