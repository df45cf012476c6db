// SPDX-License-Identifier: BSD-3-Clause
#include "localise.h"

#include <utility>

#include "commands.h"
#include "image_loader.h"
#include "pipeline/frame_colours.h"
#include "progress.h"
#include "sslcd/core/error.h"
#include "sslcd/pipeline/localiser.h"
#include "sslcd/store/map_store.h"
#include "store/site.h"

namespace sslcd::apps {

void AddTo(CLI::App& command, StretchArguments& stretch) {
  command.add_option("--from", stretch.from, "first frame of the stretch")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--frames", stretch.frames, "number of frames; default: all")
      ->check(CLI::PositiveNumber);
}

std::vector<Frame> StretchOf(const Dataset& dataset, const StretchArguments& a) {
  std::vector<Frame> stretch;
  for (const Frame& frame : dataset.frames)
    if (frame.index >= a.from && (a.frames == 0 || static_cast<int>(stretch.size()) < a.frames))
      stretch.push_back(frame);
  if (!stretch.empty()) return stretch;
  throw Error(ErrorKind::kUsage, "--from " + std::to_string(a.from) + ": the last frame is " +
                                     std::to_string(dataset.frames.size() - 1));
}

bool IsFound(const Attempt& attempt) { return attempt.found.decision == LoopDecision::kAccepted; }

std::vector<Attempt> LocaliseInMap(const std::string& map, const Dataset& dataset,
                                   const std::vector<Frame>& stretch, bool first,
                                   const Console& console) {
  const MapStore store(map);
  const MapInfo info = store.Describe();
  CheckBelongs(info, map, {GravityFrame::FromUp(dataset.up_axis), dataset.labels, {}},
               std::nullopt);
  const Options options = OptionsOf(info, map);
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
    CheckVectorLengths(info, map, frame);
    std::optional<Localisation> found = localiser.AddFrame(frame);
    progress.Report(++done, static_cast<int>(stretch.size()));
    // a short stretch, or what came after the last attempt
    if (!found && done == static_cast<int>(stretch.size())) found = localiser.Attempt();
    if (found) attempts.push_back({*std::move(found), frame.stamp});
    if (first && !attempts.empty() && IsFound(attempts.back())) break;
  }
  console.EndStatus();
  return attempts;
}

}  // namespace sslcd::apps
