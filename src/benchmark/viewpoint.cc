// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/viewpoint.h"

#include <cmath>
#include <filesystem>
#include <optional>

#include "benchmark/foreign.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd::benchmark {
namespace {

// Whole degrees, since they are part of a folder name.
std::optional<int> Degrees(const std::string& text) {
  const std::optional<double> number = ParseNumber(text);
  if (!number || *number != std::floor(*number) || *number < 0 || *number > 180)
    return std::nullopt;
  return static_cast<int>(*number);
}

std::string RenderCommand(const std::string& folder, const Trial& trial) {
  const auto degrees = [](double value) { return std::to_string(std::lround(value)); };
  const sim::HalvScene& scene = trial.place.scene;
  std::string command = "sslcd_sim halv --case " + std::to_string(trial.case_number) + " --seed " +
                        std::to_string(trial.seed);
  if (scene.viewpoint_low_deg >= 0)
    command += " --viewpoint-low-deg " + degrees(scene.viewpoint_low_deg) +
               " --viewpoint-high-deg " + degrees(scene.viewpoint_high_deg);
  return command + " --render --out " + folder;
}

}  // namespace

Place PlaceAtViewpoint(const std::string& range) {
  const std::size_t dash = range.find('-');
  const auto low = Degrees(range.substr(0, dash));
  const auto high = dash == std::string::npos ? std::nullopt : Degrees(range.substr(dash + 1));
  if (!low || !high || *low >= *high)
    throw Error(ErrorKind::kUsage,
                "--viewpoints '" + range +
                    "' is no range of angles: write LOW-HIGH in whole degrees, from 0 to 180, "
                    "e.g. 45-60");
  Place place;
  place.key = "lot-v" + std::to_string(*low) + "-" + std::to_string(*high);
  place.cases = {4};
  place.way_back_only = true;
  place.scene.viewpoint_low_deg = *low;
  place.scene.viewpoint_high_deg = *high;
  return place;
}

std::vector<std::string> ViewpointRanges() {
  std::vector<std::string> ranges;
  for (int low = 0; low < 180; low += 15)
    ranges.push_back(std::to_string(low) + "-" + std::to_string(low + 15));
  return ranges;
}

void CheckRendered(const std::string& folder, const std::vector<Trial>& trials) {
  constexpr double kSame = 0.01;  // [m]
  for (const Trial& trial : trials) {
    const std::string sequence = folder + "/" + trial.World();
    const std::string way_out = "; make it with: " + RenderCommand(sequence, trial);
    if (!std::filesystem::is_directory(sequence + "/image_2"))
      throw Error(ErrorKind::kBadInput, {sequence},
                  "is not there, or has no images in image_2" + way_out);
    sim::HalvScene scene = trial.place.scene;
    scene.case_number = trial.case_number;
    const Trajectory truth = sim::MakeHalvWorld(trial.seed, scene).world.truth;
    double off = 0;
    try {
      off = ForeignAte(sequence + "/groundtruth.txt", truth).max;
    } catch (const Error& problem) {
      throw Error(ErrorKind::kBadInput, problem.what() + way_out);
    }
    if (!(off < kSame))
      throw Error(ErrorKind::kBadInput, {sequence},
                  "is of another world, by its groundtruth.txt" + way_out);
  }
}

}  // namespace sslcd::benchmark
