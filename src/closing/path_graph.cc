// SPDX-License-Identifier: BSD-3-Clause
#include "closing/path_graph.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace sslcd {

void PathGraph::AddShortcut(double a_m, double b_m) {
  shortcuts_[a_m].push_back(b_m);
  shortcuts_[b_m].push_back(a_m);
}

// Dijkstra over the ends of the shortcuts.
PathGraph::Distances PathGraph::From(double from_m) const {
  Distances result;
  result.from_m_ = from_m;
  std::priority_queue<std::pair<double, double>, std::vector<std::pair<double, double>>,
                      std::greater<>>
      open;
  const auto visit = [&](double end, double distance) {
    const auto [known, is_new] = result.distance_.insert({end, distance});
    if (!is_new && known->second <= distance) return;
    known->second = distance;
    open.push({distance, end});
  };
  const auto visit_neighbours = [&](double at, double distance) {
    const auto after = shortcuts_.upper_bound(at);
    if (after != shortcuts_.end()) visit(after->first, distance + after->first - at);
    const auto here = shortcuts_.lower_bound(at);
    if (here != shortcuts_.begin())
      visit(std::prev(here)->first, distance + at - std::prev(here)->first);
  };
  if (shortcuts_.count(from_m) > 0) visit(from_m, 0);
  visit_neighbours(from_m, 0);
  while (!open.empty()) {
    const auto [distance, end] = open.top();
    open.pop();
    if (distance > result.distance_.at(end)) continue;
    visit_neighbours(end, distance);
    for (const double other : shortcuts_.at(end)) visit(other, distance);
  }
  return result;
}

double PathGraph::Distances::To(double to_m) const {
  double best = std::abs(to_m - from_m_);
  const auto after = distance_.lower_bound(to_m);
  if (after != distance_.end()) best = std::min(best, after->second + after->first - to_m);
  if (after != distance_.begin()) {
    const auto before = std::prev(after);
    best = std::min(best, before->second + to_m - before->first);
  }
  return best;
}

}  // namespace sslcd
