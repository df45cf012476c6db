// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "dataset_options.h"
#include "examples.h"
#include "formats/atomic_file.h"
#include "localise.h"
#include "overwriting.h"
#include "sslcd/core/log.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd::apps {
namespace {

constexpr int kNotFound = 5;  // exit code, as of other commands without a solution

struct RelocaliseArguments {
  DatasetRequest request;
  std::string map, out;
  StretchArguments stretch;
  bool first = false, json = false;
};

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

int Relocalise(const RelocaliseArguments& a, const Console& console) {
  const Dataset dataset = LoadDataset(a.request);
  for (const std::string& warning : dataset.warnings) Log(LogLevel::kWarning, warning);
  RefuseOverwriting({dataset.odometry_path, dataset.detections_path, a.map}, {a.out});
  const std::vector<Attempt> attempts =
      LocaliseInMap(a.map, dataset, StretchOf(dataset, a.stretch), a.first, console);
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
  AddTo(*command, a.request);
  AddTo(*command, a.stretch);
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
