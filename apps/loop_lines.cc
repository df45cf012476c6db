// SPDX-License-Identifier: BSD-3-Clause
#include "loop_lines.h"

#include <cmath>
#include <utility>

namespace sslcd::apps {
namespace {

constexpr std::size_t kMany = 8;  // loops at once
constexpr double kNearlyOne = .9999;

}  // namespace

std::string LoopText(const LoopClosure& loop, const std::function<std::string(int)>& frame_name) {
  std::string text = "frame " + frame_name(loop.query_frame) + " to " +
                     frame_name(loop.match_frame) + ", viewpoint change " +
                     Number("%.0f", loop.viewpoint_change_rad * 180 / M_PI) + " deg, " +
                     std::to_string(loop.pairs.size()) + " objects";
  if (loop.probability)
    text += ", probability " +
            (*loop.probability > kNearlyOne ? "> 0.9999" : Number("%.4f", *loop.probability));
  return text;
}

void LoopLines::Begin(const std::vector<LoopClosure>& known, std::function<std::string(int)> name) {
  for (const LoopClosure& loop : WithoutEarly(known)) known_[loop.id] = loop.decision;
  frame_name_ = std::move(name);
}

void LoopLines::Report(const std::vector<LoopClosure>& changed) {
  std::vector<const LoopClosure*> accepted, withdrawn, refused;
  for (const LoopClosure& loop : changed) {
    if (loop.early) continue;  // the camera's own attempt follows
    const auto [at, is_new] = known_.try_emplace(loop.id, loop.decision);
    const bool was = !is_new && at->second == LoopDecision::kAccepted;
    const bool is = loop.decision == LoopDecision::kAccepted;
    if (is && !was) accepted.push_back(&loop);
    if (was && !is) withdrawn.push_back(&loop);
    if (is_new && !is) refused.push_back(&loop);
    at->second = loop.decision;
  }
  Print("loop", accepted, false);
  Print("loop withdrawn", withdrawn, true);
  if (console_.verbose) Print("no loop", refused, true);
}

void LoopLines::Print(const std::string& event, const std::vector<const LoopClosure*>& loops,
                      bool with_reason) const {
  if (loops.size() > kMany && !console_.verbose) {
    console_.Say(event + ": " + std::to_string(loops.size()) + " at once (-v: a line for each)");
    return;
  }
  for (const LoopClosure* loop : loops)
    console_.Say(event + ": " + LoopText(*loop, frame_name_) +
                 (with_reason ? "; " + loop->reason : ""));
}

}  // namespace sslcd::apps
