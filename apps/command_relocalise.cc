// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "commands.h"
#include "examples.h"
#include "formats/atomic_file.h"
#include "image_loader.h"
#include "overwriting.h"
#include "pipeline/frame_colours.h"
#include "progress.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"
#include "sslcd/datasets/dataset.h"
#include "sslcd/pipeline/localiser.h"
#include "sslcd/store/map_store.h"
#include "store/site.h"

namespace sslcd::apps {
namespace {

constexpr int kNotFound = 5;  // exit code, as of other commands without a solution

struct RelocaliseArguments {
  DatasetRequest request;
  std::string map, out;
  int from = 0, frames = 0;
  bool first = false, json = false;
};

// An attempt, with the stamp of its frame.
struct Attempt {
  Localisation found;
  double stamp = 0;
};

bool IsFound(const Attempt& attempt) { return attempt.found.decision == LoopDecision::kAccepted; }

bool HasPose(const Localisation& found) { return !found.pairs.empty(); }

// Standard deviation of the position, over all directions. [m]
double PositionSigma(const Localisation& found) {
  return std::sqrt(found.covariance.diagonal().head<3>().sum());
}

double RotationSigma(const Localisation& found) {
  return std::sqrt(found.covariance.diagonal().tail<3>().sum());
}

std::string Csv(const std::vector<Attempt>& attempts) {
  std::string text =
      "frame,stamp,path_m,decision,probability,objects,matches,x,y,z,qx,qy,qz,qw,sigma_m,"
      "sigma_rad,reason\n";
  for (const Attempt& attempt : attempts) {
    const Localisation& a = attempt.found;
    text += std::to_string(a.frame) + "," + Number("%.6f", attempt.stamp) + "," +
            Number("%.2f", a.travelled_m) + "," + ToString(a.decision) + ",";
    if (HasPose(a)) text += Number("%.6f", a.probability);
    text += "," + std::to_string(a.objects_in_view) + "," + std::to_string(a.pairs.size());
    const auto q = a.T_map_cam.so3().unit_quaternion();
    const Vec3 t = a.T_map_cam.translation();
    for (const double value :
         {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w(), PositionSigma(a), RotationSigma(a)})
      text += HasPose(a) ? "," + Number("%.6f", value) : ",";
    text += ",\"" + a.reason + "\"\n";
  }
  return text;
}

nlohmann::ordered_json JsonOf(const Attempt& attempt) {
  const Localisation& a = attempt.found;
  nlohmann::ordered_json json = {{"frame", a.frame},        {"stamp", attempt.stamp},
                                 {"path_m", a.travelled_m}, {"decision", ToString(a.decision)},
                                 {"reason", a.reason},      {"objects", a.objects_in_view}};
  if (!HasPose(a)) return json;
  const auto q = a.T_map_cam.so3().unit_quaternion();
  const Vec3 t = a.T_map_cam.translation();
  json["probability"] = a.probability;
  json["position"] = {t.x(), t.y(), t.z()};
  json["quaternion_xyzw"] = {q.x(), q.y(), q.z(), q.w()};
  json["sigma_m"] = PositionSigma(a);
  json["sigma_rad"] = RotationSigma(a);
  for (const auto& [here, there] : a.pairs) json["landmarks"].push_back(there.value);
  return json;
}

std::string Describe(const Attempt& attempt) {
  const Localisation& a = attempt.found;
  const Vec3 t = a.T_map_cam.translation();
  return "frame " + std::to_string(a.frame) + ", after " + Number("%.0f", a.travelled_m) +
         " m: at (" + Number("%.2f", t.x()) + ", " + Number("%.2f", t.y()) + ", " +
         Number("%.2f", t.z()) + "), +- " + Number("%.2f", PositionSigma(a)) + " m, probability " +
         Number("%.4f", a.probability) + ", " + a.reason;
}

// The frames from number `from` on, at most `frames` of them; 0: all.
std::vector<Frame> Stretch(const RelocaliseArguments& a, const Dataset& dataset) {
  std::vector<Frame> stretch;
  for (const Frame& frame : dataset.frames)
    if (frame.index >= a.from && (a.frames == 0 || static_cast<int>(stretch.size()) < a.frames))
      stretch.push_back(frame);
  if (!stretch.empty()) return stretch;
  throw Error(ErrorKind::kUsage, "--from " + std::to_string(a.from) + ": the last frame is " +
                                     std::to_string(dataset.frames.size() - 1));
}

std::vector<Attempt> Localise(const RelocaliseArguments& a, const Dataset& dataset,
                              const Console& console) {
  const MapStore store(a.map);
  const MapInfo info = store.Describe();
  CheckBelongs(info, a.map, {GravityFrame::FromUp(dataset.up_axis), dataset.labels, {}},
               std::nullopt);
  const Options options = OptionsOf(info, a.map);
  const std::vector<Frame> stretch = Stretch(a, dataset);
  Localiser localiser(store.Reference(), options, dataset.camera);
  RunHooks hooks;
  hooks.with_image = WithImage;
  CatchInterrupt();
  std::vector<Attempt> attempts;
  Progress progress(console, "frame");
  int done = 0;
  for (Frame frame : stretch) {
    if (Interrupted()) break;
    if (LacksColour(frame)) AddColours(frame, options.colour, hooks);
    CheckVectorLengths(info, a.map, frame);
    std::optional<Localisation> found = localiser.AddFrame(frame);
    progress.Report(++done, static_cast<int>(stretch.size()));
    // a short stretch, or what came after the last attempt
    if (!found && done == static_cast<int>(stretch.size())) found = localiser.Attempt();
    if (found) attempts.push_back({*std::move(found), frame.stamp});
    if (a.first && !attempts.empty() && IsFound(attempts.back())) break;
  }
  console.EndStatus();
  return attempts;
}

int Relocalise(const RelocaliseArguments& a, const Console& console) {
  const Dataset dataset = LoadDataset(a.request);
  for (const std::string& warning : dataset.warnings) Log(LogLevel::kWarning, warning);
  RefuseOverwriting({dataset.odometry_path, dataset.detections_path, a.map}, {a.out});
  const std::vector<Attempt> attempts = Localise(a, dataset, console);
  int found = 0;
  const Attempt *first = nullptr, *last = nullptr;
  for (const Attempt& attempt : attempts) {
    if (!IsFound(attempt)) continue;
    ++found;
    if (first == nullptr) first = &attempt;
    last = &attempt;
  }
  if (!a.out.empty()) WriteFileAtomically(a.out, Csv(attempts));
  if (a.json) {
    auto json = nlohmann::ordered_json::array();
    for (const Attempt& attempt : attempts) json.push_back(JsonOf(attempt));
    std::printf("%s\n", json.dump(2).c_str());
  }
  console.Say(std::to_string(attempts.size()) + " attempts, " + std::to_string(found) + " found");
  if (first != nullptr) console.Say("first: " + Describe(*first));
  if (first != last) console.Say("last: " + Describe(*last));
  if (!a.out.empty()) console.Say("wrote " + a.out);
  if (Interrupted()) return InterruptCode();
  if (first != nullptr) return 0;
  console.Say("not found: " +
              (attempts.empty() ? "there was no attempt" : attempts.back().found.reason));
  return kNotFound;
}

}  // namespace

Command AddRelocaliseCommand(CLI::App& app, Console& console) {
  CLI::App* command =
      app.add_subcommand("relocalise", "find a drive, or a stretch of it, in a map in a file");
  const auto arguments = std::make_shared<RelocaliseArguments>();
  RelocaliseArguments& a = *arguments;
  command->add_option("DATASET", a.request.path, "dataset folder")->required();
  command->add_option("--map", a.map, "file of the map, which is only read")->required();
  command->add_option("--format", a.request.format, "layout of the folder; guessed where not given")
      ->check(CLI::IsMember(DatasetFormatNames()));
  command->add_option("--sequence", a.request.sequence, "which sequence of the dataset");
  command->add_option("--detections", a.request.detections,
                      "file or folder, relative to DATASET or the current folder");
  command->add_option("--odometry", a.request.odometry, "poses, likewise");
  command->add_option("--from", a.from, "first frame of the stretch")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--frames", a.frames, "number of frames; default: all")
      ->check(CLI::PositiveNumber);
  command->add_flag("--first", a.first, "stop at the first answer");
  command->add_option("--out", a.out, "CSV file to write: a row for each attempt");
  command->add_flag("--json", a.json, "print all attempts as JSON and nothing else");
  command->add_flag("-q,--quiet", console.quiet, "print errors only");
  command->footer(
      Examples({"relocalise my_sequence --map site.db",
                "relocalise my_sequence --map site.db --from 20 --frames 15 --out answers.csv"}));
  return [arguments, &console] {
    if (arguments->json) console.quiet = true;
    console.InstallLog();
    return Relocalise(*arguments, console);
  };
}

}  // namespace sslcd::apps
