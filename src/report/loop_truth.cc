// SPDX-License-Identifier: BSD-3-Clause
#include "report/loop_truth.h"

#include <algorithm>
#include <cmath>

namespace sslcd {
namespace {

constexpr double kMatchTolerance = .01;  // of the stamps of a true pose and a frame, as in evo [s]

}  // namespace

std::vector<int> TrueRows(const RunView& run) {
  std::vector<int> nearest;
  const auto& many = run.truth.stamps;
  for (const double stamp : run.trajectory.stamps) {
    auto at = std::lower_bound(many.begin(), many.end(), stamp);
    if (at != many.begin() && (at == many.end() || stamp - at[-1] <= *at - stamp)) --at;
    const bool found = at != many.end() && std::abs(*at - stamp) <= kMatchTolerance;
    nearest.push_back(found ? static_cast<int>(at - many.begin()) : -1);
  }
  return nearest;
}

std::optional<double> LoopError(const RunView& run, const std::vector<int>& true_rows,
                                const LoopClosure& loop) {
  const auto truth = [&](int frame) {
    const bool there = frame >= 0 && static_cast<std::size_t>(frame) < true_rows.size();
    return there ? true_rows[static_cast<std::size_t>(frame)] : -1;
  };
  const int query = truth(loop.query_frame), match = truth(loop.match_frame);
  if (query < 0 || match < 0) return std::nullopt;
  const Pose T = run.truth.poses[static_cast<std::size_t>(match)].inverse() *
                 run.truth.poses[static_cast<std::size_t>(query)];
  return (loop.T_match_query.translation() - T.translation()).norm();
}

}  // namespace sslcd
