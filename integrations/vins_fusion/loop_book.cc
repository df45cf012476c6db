// SPDX-License-Identifier: BSD-3-Clause
#include "loop_book.h"

#include <algorithm>
#include <utility>

namespace sslcd::vins {
namespace {

// Of the odometry between keyframes that are some metres apart: VINS's own drift is ten times less.
constexpr double kTranslationShare = 0.02;  // [m/m]
constexpr double kRotation = 0.002;         // [rad]

// Smaller changes are not worth an optimisation. [m, rad]
constexpr double kSameEdge = 5e-3;

bool IsSame(const LoopEdge& a, const LoopEdge& b) {
  return a.id == b.id && a.old == b.old &&
         (a.measured.T_a_b.inverse() * b.measured.T_a_b).Log().norm() < kSameEdge &&
         (a.measured.covariance - b.measured.covariance).norm() <
             kSameEdge * a.measured.covariance.norm();
}

}  // namespace

LoopEdge EdgeBetween(const LoopClosure& loop, const Keyframe& cur, const Keyframe& old,
                     double scale) {
  Pose::Matrix6 covariance = loop.covariance;
  covariance.topRows<3>() /= scale;
  covariance.leftCols<3>() /= scale;
  const Pose T_match_query(loop.T_match_query.so3(), loop.T_match_query.translation() / scale);
  // T_old_cur Exp(Adj(T_cur_query) d) = T_old_match T_match_query Exp(d) T_query_cur
  const Pose::Matrix6 to_body = cur.T_body_cam.Adj();
  LoopEdge edge{loop.id, cur.index, old.index, {}};
  edge.measured.T_a_b = old.T_body_cam * T_match_query * cur.T_body_cam.inverse();
  edge.measured.covariance = to_body * covariance * to_body.transpose();
  return edge;
}

LoopEdge MovedTo(const Keyframe& to, const Keyframe& from, const LoopEdge& edge) {
  RelativePose step;
  step.T_a_b = from.T_odom_body.inverse() * to.T_odom_body;
  const double sigma_m = kTranslationShare * step.T_a_b.translation().norm();
  step.covariance.setZero();
  step.covariance.diagonal().head<3>().setConstant(sigma_m * sigma_m);
  step.covariance.diagonal().tail<3>().setConstant(kRotation * kRotation);
  return {edge.id, to.index, edge.old, Compose(edge.measured, step)};
}

const Keyframe* LoopBook::Find(int index) const {
  const auto at = keyframes_.find(index);
  return at == keyframes_.end() ? nullptr : &at->second;
}

const Keyframe* LoopBook::NearestFree(const LoopEdge& edge,
                                      const std::map<int, LoopEdge>& taken) const {
  const int sequence = keyframes_.at(edge.cur).sequence;
  for (int steps = 0; steps <= kMostMoved; ++steps) {
    for (const int index : {edge.cur - steps, edge.cur + steps}) {
      const Keyframe* keyframe = Find(index);
      if (keyframe && keyframe->sequence == sequence && !keyframe->has_own_loop &&
          index > edge.old && taken.count(index) == 0)
        return keyframe;
    }
  }
  return nullptr;
}

std::map<int, LoopEdge> LoopBook::Assign(double scale) const {
  std::vector<std::pair<double, LoopEdge>> by_size;
  for (const auto& [id, loop] : accepted_) {
    const Keyframe* cur = Find(loop.query_frame);
    const Keyframe* old = Find(loop.match_frame);
    if (!cur || !old) continue;
    const LoopEdge edge = EdgeBetween(loop, *cur, *old, scale);
    by_size.emplace_back(edge.measured.covariance.determinant(), edge);
  }
  std::stable_sort(by_size.begin(), by_size.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::map<int, LoopEdge> edges;
  std::vector<LoopEdge> others;
  for (const auto& [size, edge] : by_size) {
    if (!Find(edge.cur)->has_own_loop && edges.count(edge.cur) == 0)
      edges[edge.cur] = edge;
    else
      others.push_back(edge);
  }
  for (const LoopEdge& edge : others) {
    const Keyframe* free = NearestFree(edge, edges);
    if (free) edges[free->index] = MovedTo(*free, keyframes_.at(edge.cur), edge);
  }
  return edges;
}

EdgeChanges LoopBook::Update(const std::vector<LoopClosure>& changed, double scale) {
  for (const LoopClosure& loop : changed) {
    if (loop.decision == LoopDecision::kAccepted)
      accepted_[loop.id] = loop;
    else
      accepted_.erase(loop.id);
  }
  std::map<int, LoopEdge> edges = Assign(scale);
  EdgeChanges changes;
  for (const auto& [cur, edge] : edges_)
    if (edges.count(cur) == 0) changes.cleared.push_back(cur);
  for (auto& [cur, edge] : edges) {
    const auto before = edges_.find(cur);
    if (before != edges_.end() && IsSame(before->second, edge))
      edge = before->second;  // so that small changes add up
    else
      changes.set.push_back(edge);
  }
  edges_ = std::move(edges);
  return changes;
}

}  // namespace sslcd::vins
