// SPDX-License-Identifier: BSD-3-Clause
#include "run_tables.h"

#include <algorithm>

#include "console.h"
#include "eval/odometry_returns.h"
#include "loop_lines.h"

namespace sslcd::apps {
namespace {

using Rows = std::vector<std::vector<std::string>>;

// A probability of improvement; zero says that nothing was judged.
std::string Judged(double probability) {
  return probability > 0 ? Number("%.3f", probability) : "-";
}

std::string FrameOf(const RunResult& result, std::size_t row) {
  return row < result.frames.size() ? std::to_string(result.frames[row]) : std::to_string(row);
}

// Whether the odometry passes a place twice.
std::vector<std::string> ReturnsRow(const RunResult& result, const Vec3& up) {
  const ReturnOptions options;
  const OdometryReturns returns = FindReturns(result.odometry, up, options);
  const std::string name = "odometry comes back within " + Number("%.0f", options.radius_m) + " m";
  if (!returns.nearest) return {name, "never; its path is too short"};
  const Approach& near = *returns.nearest;
  return {name, (returns.stretches == 0   ? "never"
                 : returns.stretches == 1 ? "once"
                                          : std::to_string(returns.stretches) + " times") +
                    "; nearest: " + Number("%.1f", near.distance_m) + " m, frame " +
                    FrameOf(result, near.query) + " to " + FrameOf(result, near.match) +
                    ", path of " + Number("%.0f", near.path_m) + " m between"};
}

// The refused attempt with the largest log odds, and what refused it.
std::string NearestMiss(const std::vector<LoopClosure>& loops) {
  const auto best = std::max_element(
      loops.begin(), loops.end(),
      [](const LoopClosure& a, const LoopClosure& b) { return a.score < b.score; });
  if (best == loops.end()) return "-";
  return LoopText(*best, [](int frame) { return std::to_string(frame); }) + "; " + best->reason;
}

// Two columns, both aligned left.
std::string List(const Rows& rows) {
  std::size_t width = 0;
  for (const auto& row : rows) width = std::max(width, row[0].size());
  std::string text;
  for (const auto& row : rows)
    text += "\n  " + row[0] + std::string(width - row[0].size() + 2, ' ') + row[1];
  return text;
}

}  // namespace

int Landmarks(const RunResult& result) {
  int landmarks = 0;
  for (const MapObject& object : result.objects)
    landmarks += object.state == LandmarkState::kConfirmed;
  return landmarks;
}

int LoopsOf(const RunResult& result, LoopDecision decision) {
  int loops = 0;
  for (const LoopClosure& loop : result.loops) loops += loop.decision == decision;
  return loops;
}

std::string ResultTable(const RunResult& result, const Metrics& metrics) {
  const int accepted = LoopsOf(result, LoopDecision::kAccepted);
  Rows rows = {{"frames", std::to_string(result.frames.size())},
               {"detections used", std::to_string(result.filter.kept)},
               {"detections dropped", std::to_string(result.filter.dropped())},
               {"landmarks", std::to_string(Landmarks(result))},
               {"loops accepted", std::to_string(accepted)},
               {"loops refused", std::to_string(static_cast<int>(result.loops.size()) - accepted)},
               {"views tied", std::to_string(result.views_tied)},
               {"odometry scale", Number("%.4f", result.scale)},
               {"probability better, horizontally", Judged(result.improvement.horizontal)},
               {"probability better, in height", Judged(result.improvement.height)}};
  for (const auto& [name, value] : metrics)
    rows.push_back({name, value ? Number("%.4f", *value) : "-"});
  return AlignedTable(rows);
}

std::string NoLoopTable(const RunResult& result, const LoopOptions& options, const Vec3& up) {
  if (!options.enabled) return "no loop was looked for (loop.enabled: false)";
  const LoopSearchSummary& search = result.loop_search;
  Rows rows = {{"objects in the map", std::to_string(Landmarks(result))},
               ReturnsRow(result, up),
               {"searches", std::to_string(search.searches)},
               {"  too few objects in sight, or in the map, agree",
                std::to_string(search.without_candidate)}};
  std::vector<std::pair<int, std::string>> reasons;
  for (const auto& [reason, count] : search.refused) reasons.emplace_back(-count, reason);
  std::sort(reasons.begin(), reasons.end());
  for (const auto& [count, reason] : reasons)
    rows.push_back({"  refused: " + reason, std::to_string(-count)});
  rows.push_back({"nearest miss", NearestMiss(result.loops)});
  if (!search.up_axis_is_plausible)
    rows.push_back({"up axis", "wrong: the cameras turn about another axis than the given one"});
  return "no loop was found" + List(rows);
}

}  // namespace sslcd::apps
