// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_factors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "odometry/pattern_search.h"

namespace sslcd {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

// Smallest path between the loops of a cycle, so that cycles are different. Set by hand. [m]
constexpr double kApart = 40;
// Standard deviation of the log of a factor about 0. Of .3 to 1 on Victoria Park, poles 00, 02 and
// 05, both forests, HALV-sim and eight worlds (docs/notes, "The odometry's noise").
constexpr double kPriorSigma = 0.45;

/// The odometry alone: its trajectory and path, and the covariances by noise, the failures and the
/// up direction of the step to each vertex.
struct Chain {
  std::vector<Pose> poses;
  std::vector<double> travelled;
  std::vector<Eigen::Matrix3d> translation_covariance, rotation_covariance;
  std::vector<OdometryFailures> failures;
  std::vector<Vec3> up;      // in the vertex's frame
  std::map<int, int> index;  // id -> vertex
};

/// A loop as indices of vertices; the first is the older one.
struct Loop {
  int old = 0, now = 0;
  Pose T_old_now;
  Mat6 covariance;
};

/// The closing error of a cycle and its covariance: a part that does not depend on the factors, and
/// parts that do, for factors of one.
struct Cycle {
  Vec6 error;
  Mat6 fixed = Mat6::Zero(), horizontal = Mat6::Zero(), heading = Mat6::Zero();
};

Chain ChainOf(const PoseGraph& graph, const Vec3& up,
              const std::vector<OdometryFailures>& failures) {
  Chain chain;
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    chain.index[graph.vertices[i].id] = static_cast<int>(i);
    const bool first = i == 0;
    const PoseGraph::Edge step = first ? PoseGraph::Edge() : graph.edges[i - 1];
    chain.poses.push_back(first ? Pose() : chain.poses.back() * step.T_from_to);
    chain.travelled.push_back(first ? 0.
                                    : chain.travelled.back() + step.T_from_to.translation().norm());
    chain.up.push_back(graph.vertices[i].T_world_vertex.so3().inverse() * up);
    const OdometryFailures failed =
        first || failures.empty() ? OdometryFailures() : failures.at(i - 1);
    chain.failures.push_back(failed);
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    chain.translation_covariance.push_back(step.information.topLeftCorner<3, 3>().inverse() -
                                           failed.translation_m2 * one);
    chain.rotation_covariance.push_back(step.information.bottomRightCorner<3, 3>().inverse() -
                                        failed.rotation_rad2 * one);
  }
  return chain;
}

// Loops in the order of the path, with a minimum path between them.
std::vector<Loop> LoopsApart(const PoseGraph& graph, const Chain& chain) {
  std::vector<Loop> loops, apart;
  for (const PoseGraph::Edge& edge : graph.edges) {
    if (!edge.loop) continue;
    Loop loop{chain.index.at(edge.from), chain.index.at(edge.to), edge.T_from_to,
              Mat6(edge.information).inverse()};
    if (loop.old > loop.now) {
      const Mat6 adjoint = loop.T_old_now.Adj();
      loop = {loop.now, loop.old, loop.T_old_now.inverse(),
              adjoint * loop.covariance * adjoint.transpose()};
    }
    loops.push_back(loop);
  }
  std::sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
    return std::make_pair(a.now, a.old) < std::make_pair(b.now, b.old);
  });
  for (const Loop& loop : loops)
    if (apart.empty() || chain.travelled[loop.now] - chain.travelled[apart.back().now] >= kApart)
      apart.push_back(loop);
  return apart;
}

// The covariance that the steps between vertices `a` and `b` add to a cycle that ends at `end`
// [odometry's world].
void AddSteps(const Chain& chain, int a, int b, const Pose& T_end_world, Cycle& cycle) {
  for (int k = std::min(a, b) + 1; k <= std::max(a, b); ++k) {
    const Mat6 J = (T_end_world * chain.poses[k]).Adj();
    const Eigen::Matrix3d vertical = chain.up[k] * chain.up[k].transpose();
    const Eigen::Matrix3d level = Eigen::Matrix3d::Identity() - vertical;
    const auto add = [&J](const Eigen::Matrix3d& covariance, int first,
                          const Eigen::Matrix3d& along, Mat6& to) {
      to +=
          J.middleCols<3>(first) * along * covariance * along * J.middleCols<3>(first).transpose();
    };
    add(chain.translation_covariance[k], 0, level, cycle.horizontal);
    add(chain.translation_covariance[k], 0, vertical, cycle.fixed);
    add(chain.rotation_covariance[k], 3, vertical, cycle.heading);
    add(chain.rotation_covariance[k], 3, level, cycle.fixed);
    const OdometryFailures& failed = chain.failures[k];
    cycle.fixed += failed.translation_m2 * J.leftCols<3>() * J.leftCols<3>().transpose() +
                   failed.rotation_rad2 * J.rightCols<3>() * J.rightCols<3>().transpose();
  }
}

std::vector<Cycle> CyclesOf(const Chain& chain, const std::vector<Loop>& loops) {
  std::vector<Cycle> cycles;
  const Loop* before = nullptr;
  for (const Loop& loop : loops) {
    Cycle& cycle = cycles.emplace_back();
    const Pose T_now_world = chain.poses[loop.now].inverse();
    const Pose T_now_old =
        loop.T_old_now.inverse() *
        chain.poses[loop.old].inverse();  // world of the old vertex through the loop
    cycle.fixed = loop.covariance;
    if (!before) {  // the path closes the first cycle
      cycle.error = (T_now_old * chain.poses[loop.now]).Log();
      AddSteps(chain, loop.old, loop.now, T_now_world, cycle);
    } else {
      const Pose around =
          chain.poses[before->old] * before->T_old_now * chain.poses[before->now].inverse();
      cycle.error = (T_now_old * around * chain.poses[loop.now]).Log();
      const Mat6 J = (T_now_world * chain.poses[before->now]).Adj();
      cycle.fixed += J * before->covariance * J.transpose();
      AddSteps(chain, before->now, loop.now, T_now_world, cycle);
      AddSteps(chain, before->old, loop.old, T_now_old, cycle);
    }
    before = &loop;
  }
  return cycles;
}

double LogPosterior(const std::vector<Cycle>& cycles, const std::array<double, 2>& log_factors) {
  const double horizontal = std::exp(2 * log_factors[0]), heading = std::exp(2 * log_factors[1]);
  double sum = 0;
  for (const double log_factor : log_factors) sum -= 0.5 * std::pow(log_factor / kPriorSigma, 2);
  for (const Cycle& cycle : cycles) {
    const Mat6 covariance = cycle.fixed + horizontal * cycle.horizontal + heading * cycle.heading;
    const Eigen::LLT<Mat6> llt(covariance);
    sum -= 0.5 * llt.matrixL().solve(Eigen::Matrix<double, 6, 1>(cycle.error)).squaredNorm();
    sum -= llt.matrixLLT().diagonal().array().log().sum();
  }
  return sum;
}

}  // namespace

OdometryFactors LearnOdometryFactors(const PoseGraph& graph, const Vec3& up,
                                     const std::vector<OdometryFailures>& failures) {
  const Chain chain = ChainOf(graph, up, failures);
  const std::vector<Cycle> cycles = CyclesOf(chain, LoopsApart(graph, chain));
  const std::array<double, 2> best = MaximiseOverLogs<2>(
      [&](const std::array<double, 2>& factors) { return LogPosterior(cycles, factors); });
  return {std::exp(best[0]), std::exp(best[1])};
}

}  // namespace sslcd
