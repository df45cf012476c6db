// SPDX-License-Identifier: BSD-3-Clause
#include "closing/trajectory_uncertainty.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "refine/trajectory_correction.h"

namespace sslcd {
namespace {

using Mat6 = TrajectoryUncertainty::Mat6;

// Path from one vertex to the next, and most vertices: a covariance need not be more exact, and is
// asked for dozens of times per attempt. Set by hand.
constexpr double kVertexM = 20, kMostVertices = 100;
constexpr double kAnyTurn = 10;  // more than any rotation [rad]

// In the world: of perturbations Exp(xi) T_world_cam.
Mat6 InWorld(const Mat6& covariance, const Pose& T_world_cam) {
  const Mat6 to_world = T_world_cam.Adj();
  return to_world * covariance * to_world.transpose();
}

}  // namespace

TrajectoryUncertainty::TrajectoryUncertainty(const MapState& state,
                                             const std::vector<LoopEdge>& loops,
                                             const OdometryModel& odometry)
    : state_(state),
      odometry_(odometry),
      frames_(SelectKeyframes(state.frames,
                              std::max(kVertexM, state.frames.back().travelled / kMostVertices),
                              kAnyTurn)) {
  const FrameStore& frames = state.frames;
  for (const FrameRecord& frame : frames) path_of_all_.push_back(frame.travelled);
  for (const int frame : frames_) part_.push_back(frames[frame].failures.lost);
  std::vector<DifferenceMeasurement> measured;
  for (std::size_t v = 1; v < frames_.size(); ++v)
    if (part_[v - 1] == part_[v])  // a lost step measures nothing
      measured.push_back(
          {static_cast<int>(v - 1), static_cast<int>(v), Walk(frames_[v - 1], frames_[v])});
  // Loops between the same two vertices share their objects: the most certain one stands for all.
  std::map<std::pair<int, int>, const LoopEdge*> best;
  const auto variance = [](const LoopEdge& loop) {
    return Mat6(loop.closure->covariance).topLeftCorner<3, 3>().trace();
  };
  for (const LoopEdge& loop : loops) {
    const std::pair<int, int> ends{NearestVertex(loop.match), NearestVertex(loop.query)};
    if (ends.first == ends.second) continue;
    const auto [known, is_new] = best.insert({ends, &loop});
    if (!is_new && variance(loop) < variance(*known->second)) known->second = &loop;
  }
  for (const auto& [ends, loop] : best) {
    measured.push_back({ends.first, ends.second,
                        Walk(frames_[ends.first], loop->match) +
                            InWorld(loop->closure->covariance, frames[loop->query].T_world_cam) +
                            Walk(loop->query, frames_[ends.second])});
    std::replace(part_.begin(), part_.end(), int(part_[ends.second]), int(part_[ends.first]));
  }
  Solve(std::move(measured));
}

// Parts stand kilometres apart. A rotation about a point so far away moves an object by so much
// that nothing would be left of its variance, and a tie between parts that is as weak as a lost
// step drowns in rounding errors. So each part has a centre of its own, and ties to the first
// vertex that are never asked for.
void TrajectoryUncertainty::Solve(std::vector<DifferenceMeasurement> measured) {
  std::map<int, int> first;  // vertex of each part
  for (std::size_t v = 0; v < frames_.size(); ++v) first.insert({part_[v], static_cast<int>(v)});
  for (const auto& [part, vertex] : first)
    centre_[part] = vertex == 0
                        ? Pose()
                        : Pose::Trans(state_.frames[frames_[vertex]].T_world_cam.translation());
  for (DifferenceMeasurement& each : measured)
    if (part_[each.to] != part_[0])
      each.covariance = InWorld(each.covariance, centre_.at(part_[each.to]).inverse());
  for (const auto& [part, vertex] : first)
    if (vertex > 0) measured.push_back({0, vertex, Mat6::Identity()});
  covariances_.emplace(static_cast<int>(frames_.size()), measured);
}

// Of odometry alone.
Mat6 TrajectoryUncertainty::Walk(int from, int to) const {
  if (from == to) return Mat6::Zero();
  const Pose& T_world_to = state_.frames[to].T_world_cam;
  const OdometrySigmas sigmas = SigmasBetween(state_.frames, from, to, odometry_.noise);
  const Vec3 up = T_world_to.so3().inverse() * state_.gravity().up;
  return InWorld(InformationOf(sigmas, up, odometry_.factors).inverse(), T_world_to);
}

int TrajectoryUncertainty::NearestVertex(int frame) const {
  const auto after = std::lower_bound(frames_.begin(), frames_.end(), frame);
  const int vertex = static_cast<int>(after - frames_.begin());
  if (vertex == 0) return vertex;
  const double since_m = path_of_all_[frame] - path_of_all_[frames_[vertex - 1]];
  return since_m < path_of_all_[frames_[vertex]] - path_of_all_[frame] ? vertex - 1 : vertex;
}

bool TrajectoryUncertainty::Joined(int from, int to) const {
  return part_[NearestVertex(from)] == part_[NearestVertex(to)];
}

const Mat6& TrajectoryUncertainty::Between(int from, int to) const {
  const std::pair<int, int> ends{NearestVertex(from), NearestVertex(to)};
  const auto known = known_.find(ends);
  if (known != known_.end()) return known->second;
  return known_.insert({ends, BetweenVertices(ends.first, ends.second)}).first->second;
}

double TrajectoryUncertainty::Variance(int from, int to, const Vec6& direction) const {
  const int a = NearestVertex(from), b = NearestVertex(to);
  if (part_[a] != part_[b]) return direction.dot(BetweenVertices(a, b) * direction);
  return covariances_->Variance(a, b, centre_.at(part_[b]).Adj().transpose() * direction);
}

Mat6 TrajectoryUncertainty::BetweenVertices(int from, int to) const {
  if (part_[from] != part_[to]) return Walk(frames_[from], frames_[to]);
  return InWorld(covariances_->Between(from, to), centre_.at(part_[to]));
}

}  // namespace sslcd
