// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_by_loops.h"

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

using Mat3 = Eigen::Matrix3d;
using Mat6 = Eigen::Matrix<double, 6, 6>;

// Smallest path between loops, and most loops of a long path. Set by hand. [m]
constexpr double kApart = 40, kMostLoops = 150;
// Standard deviation of the log of a factor about 0. Of .3 to 1 on Victoria Park, poles 00, 02 and
// 05, both forests, HALV-sim and eight worlds (docs/notes, "The odometry's noise").
constexpr double kPriorSigma = 0.45;
// Path over which the systematic turn is expected to be as large as the random walk: it is on
// Victoria Park, and over 400 to 900 m on the poles (docs/notes, "The odometry's noise"). [m]
constexpr double kTurnPath = 100;

/// The path along the vertices. What its steps add up to from the start to each vertex, for factors
/// of one: in the plane of the layout, as motions of the world [forward, left, yaw].
struct Path {
  std::vector<double> travelled;
  std::vector<Vec3> error;                       // of the poses against the odometry
  std::vector<Vec3> turn;                        // by one radian per metre
  std::vector<Mat3> horizontal, heading, fixed;  // covariances; fixed: failures
  std::map<int, int> index;                      // id -> vertex
  double walk = 0;                               // variance of the heading per metre
};

/// A loop as indices of vertices; the first is the older one.
struct Loop {
  int old = 0, now = 0;
  Vec3 error;  // of the poses against the loop, as a motion of the world
  Mat3 covariance;
};

/// The plane of the layout, about the first vertex.
class Plane {
 public:
  Plane(const Vec3& up, const Vec3& centre) : up_(up), centre_(centre) {
    forward_ = up.unitOrthogonal();
    left_ = up.cross(forward_);
  }

  /// Maps an error [translation, rotation] in the frame of a pose to the motion of the world.
  Eigen::Matrix<double, 3, 6> Of(const Pose& T_world_vertex) const {
    Pose T = T_world_vertex;
    T.translation() -= centre_;
    Eigen::Matrix<double, 3, 6> project = Eigen::Matrix<double, 3, 6>::Zero();
    project.block<1, 3>(0, 0) = forward_.transpose();
    project.block<1, 3>(1, 0) = left_.transpose();
    project.block<1, 3>(2, 3) = up_.transpose();
    return project * T.Adj();
  }

  /// The motion of the world by a turn about a point, of one radian.
  Vec3 Turn(const Vec3& point) const {
    const Vec3 p = point - centre_;
    return {p.dot(left_), -p.dot(forward_), 1};
  }

 private:
  Vec3 up_, centre_, forward_, left_;
};

Path PathOf(const PoseGraph& graph, const Plane& plane,
            const std::vector<OdometryFailures>& failures) {
  Path path;
  const std::size_t n = graph.vertices.size();
  path.travelled.assign(n, 0);
  path.error = path.turn = std::vector<Vec3>(n, Vec3::Zero());
  path.horizontal = path.heading = path.fixed = std::vector<Mat3>(n, Mat3::Zero());
  double heading_variance = 0;
  for (std::size_t i = 0; i < n; ++i) {
    path.index[graph.vertices[i].id] = static_cast<int>(i);
    if (i == 0) continue;
    const PoseGraph::Edge& step = graph.edges[i - 1];
    const Pose &from = graph.vertices[i - 1].T_world_vertex, &to = graph.vertices[i].T_world_vertex;
    const OdometryFailures failed = failures.empty() ? OdometryFailures() : failures.at(i - 1);
    const double length = failed.lost > 0 ? 0. : step.T_from_to.translation().norm();
    const double translation =
        step.information.topLeftCorner<3, 3>().inverse().trace() / 3 - failed.translation_m2;
    const double rotation =
        step.information.bottomRightCorner<3, 3>().inverse().trace() / 3 - failed.rotation_rad2;
    const Vec3 turn = plane.Turn(to.translation());
    const Mat3 shift = Vec3(1, 1, 0).asDiagonal();
    path.travelled[i] = path.travelled[i - 1] + length;
    path.error[i] = path.error[i - 1] +
                    plane.Of(to) * Vec6((step.T_from_to.inverse() * (from.inverse() * to)).Log());
    path.turn[i] =
        path.turn[i - 1] + length * plane.Turn(0.5 * (from.translation() + to.translation()));
    path.horizontal[i] = path.horizontal[i - 1] + translation * shift;
    path.heading[i] = path.heading[i - 1] + rotation * turn * turn.transpose();
    path.fixed[i] = path.fixed[i - 1] + failed.translation_m2 * shift +
                    failed.rotation_rad2 * turn * turn.transpose();
    heading_variance += rotation;
  }
  if (n > 1 && path.travelled.back() > 0) path.walk = heading_variance / path.travelled.back();
  return path;
}

// Loops in the order of the path, with a minimum path between them.
std::vector<Loop> LoopsApart(const PoseGraph& graph, const Plane& plane, const Path& path) {
  std::vector<Loop> loops, apart;
  for (const PoseGraph::Edge& edge : graph.edges) {
    if (!edge.loop) continue;
    const int from = path.index.at(edge.from), to = path.index.at(edge.to);
    const Pose& T_world_to = graph.vertices[to].T_world_vertex;
    const Pose T_from_to = graph.vertices[from].T_world_vertex.inverse() * T_world_to;
    const Eigen::Matrix<double, 3, 6> to_world = plane.Of(T_world_to);
    Loop& loop = loops.emplace_back();
    loop.old = std::min(from, to);
    loop.now = std::max(from, to);
    loop.error = to_world * Vec6((edge.T_from_to.inverse() * T_from_to).Log());
    if (from > to) loop.error = -loop.error;
    loop.covariance = to_world * Mat6(edge.information).inverse() * to_world.transpose();
  }
  std::sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
    return std::make_pair(a.now, a.old) < std::make_pair(b.now, b.old);
  });
  const double least = std::max(kApart, path.travelled.back() / kMostLoops);
  for (const Loop& loop : loops)
    if (apart.empty() || path.travelled[loop.now] - path.travelled[apart.back().now] >= least)
      apart.push_back(loop);
  return apart;
}

/// The closing errors of all loops, three rows each, and their covariances for factors of one.
struct ClosingErrors {
  Eigen::VectorXd error, turn;
  Eigen::MatrixXd horizontal, heading, loops, fixed;
  double turn_variance = 0;  // prior, for factors of one
};

ClosingErrors ErrorsOf(const Path& path, const std::vector<Loop>& loops, double corrected) {
  ClosingErrors all;
  const Eigen::Index rows = 3 * static_cast<Eigen::Index>(loops.size());
  all.error = all.turn = Eigen::VectorXd::Zero(rows);
  all.horizontal = all.heading = all.loops = all.fixed = Eigen::MatrixXd::Zero(rows, rows);
  all.turn_variance = path.walk / kTurnPath;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(i);
    const Loop& loop = loops[i];
    all.turn.segment<3>(row) = path.turn[loop.now] - path.turn[loop.old];
    all.error.segment<3>(row) = path.error[loop.now] - path.error[loop.old] - loop.error +
                                corrected * all.turn.segment<3>(row);
    for (std::size_t j = 0; j <= i; ++j) {
      const Eigen::Index column = 3 * static_cast<Eigen::Index>(j);
      const int first = std::max(loop.old, loops[j].old), last = std::min(loop.now, loops[j].now);
      if (last <= first) continue;
      const auto set = [&](Eigen::MatrixXd& to, const std::vector<Mat3>& sums) {
        to.block<3, 3>(row, column) = to.block<3, 3>(column, row) = sums[last] - sums[first];
      };
      set(all.horizontal, path.horizontal);
      set(all.heading, path.heading);
      set(all.fixed, path.fixed);
    }
    all.loops.block<3, 3>(row, row) = loop.covariance;
  }
  return all;
}

using Factorisation = Eigen::LLT<Eigen::MatrixXd>;

Factorisation CovarianceOf(const ClosingErrors& all, const std::array<double, 2>& log_factors) {
  const double horizontal = std::exp(2 * log_factors[0]), heading = std::exp(2 * log_factors[1]);
  return Factorisation(all.fixed + all.loops + horizontal * all.horizontal + heading * all.heading +
                       heading * all.turn_variance * all.turn * all.turn.transpose());
}

double LogPosterior(const ClosingErrors& all, const std::array<double, 2>& log_factors) {
  const Factorisation covariance = CovarianceOf(all, log_factors);
  double sum = -0.5 * covariance.matrixL().solve(all.error).squaredNorm() -
               covariance.matrixLLT().diagonal().array().log().sum();
  for (const double log_factor : log_factors) sum -= 0.5 * std::pow(log_factor / kPriorSigma, 2);
  return sum;
}

}  // namespace

OdometryByLoops LearnOdometryByLoops(const PoseGraph& graph, const Vec3& up, double corrected,
                                     const std::vector<OdometryFailures>& failures) {
  if (graph.vertices.empty()) return {};
  const Plane plane(up, graph.vertices.front().T_world_vertex.translation());
  const Path path = PathOf(graph, plane, failures);
  const std::vector<Loop> loops = LoopsApart(graph, plane, path);
  if (loops.empty()) return {};
  const ClosingErrors all = ErrorsOf(path, loops, corrected);
  const std::array<double, 2> best = MaximiseOverLogs<2>(
      [&](const std::array<double, 2>& factors) { return LogPosterior(all, factors); });
  OdometryByLoops learnt;
  learnt.horizontal = std::exp(best[0]);
  learnt.heading = std::exp(best[1]);
  learnt.turn = learnt.heading * learnt.heading * all.turn_variance *
                all.turn.dot(CovarianceOf(all, best).solve(all.error));
  return std::isfinite(learnt.turn) ? learnt : OdometryByLoops();
}

}  // namespace sslcd
