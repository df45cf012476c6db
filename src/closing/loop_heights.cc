// SPDX-License-Identifier: BSD-3-Clause
#include "closing/loop_heights.h"

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "pose_graph/random_walk.h"
#include "refine/improvement.h"

namespace sslcd {
namespace {

// Standard deviation of a loop's height where the ground is not flat. In two forests loops are off
// by .17 and .24 m (rms). [m]
constexpr double kUnevenGround = 0.3;
constexpr double kSpacing = 10;  // of the points of the walk [m]
constexpr double kCreep = 1e-6;  // path of a camera at rest, per frame [m]

// A height measured between two frames, in the world. [m]
struct Rise {
  int from = 0, to = 0;
  double metres = 0, sigma = 0;
};

std::vector<Rise> RisesOf(const FrameStore& frames, const LoopLedger& loops,
                          const std::vector<ViewTie>& ties, const Vec3& up) {
  std::vector<Rise> rises;
  const auto add = [&](int from, int to, const Pose& T_from_to, double sigma) {
    const Vec3 moved = frames[from].T_world_cam.so3() * T_from_to.translation();
    rises.push_back({from, to, up.dot(moved), sigma});
  };
  for (const LoopAttempt& loop : loops.attempts())
    if (loop.accepted())
      add(loop.found.loop.match, loop.found.loop.query,
          (loop.remeasured ? *loop.remeasured : loop.row()).T_match_query, kUnevenGround);
  for (const ViewTie& tie : ties) {
    const Vec3 up_in_from = frames[tie.from].T_world_cam.so3().inverse() * up;
    const Vec3 up_in_to = tie.pose.T_a_b.so3().inverse() * up_in_from;
    const Eigen::Matrix3d covariance = tie.pose.covariance.topLeftCorner<3, 3>();
    add(tie.from, tie.to, tie.pose.T_a_b, std::sqrt(up_in_to.dot(covariance * up_in_to)));
  }
  return rises;
}

// The frames that are points of the walk: ends of the path and of what is measured, and some
// between.
std::vector<int> PointsOf(const FrameStore& frames, const std::vector<Rise>& rises) {
  std::set<int> points{0, frames.size() - 1};
  for (const Rise& rise : rises) points.insert({rise.from, rise.to});
  for (double path_m = kSpacing; path_m < frames.back().travelled; path_m += kSpacing)
    points.insert(frames.AtPath(path_m));
  for (int f = 1; f < frames.size(); ++f)
    if (IsLost(frames, f)) points.insert({f - 1, f});
  return {points.begin(), points.end()};
}

double PathAt(const FrameStore& frames, int frame) {
  return frames[frame].travelled + kCreep * frame;
}

// Linear interpolation between the points of the walk: weights of points k and k + 1 for a frame.
struct Share {
  int k = 0;
  double of_next = 0;
};
std::vector<Share> SharesOf(const FrameStore& frames, const std::vector<int>& points) {
  std::vector<Share> shares(frames.size());
  int k = 0;
  for (int f = 0; f < frames.size(); ++f) {
    while (k + 2 < static_cast<int>(points.size()) && points[k + 1] <= f) ++k;
    const double from = PathAt(frames, points[k]), to = PathAt(frames, points[k + 1]);
    shares[f] = {k, (PathAt(frames, f) - from) / (to - from)};
  }
  return shares;
}

}  // namespace

HeightCorrection HeightsByLoops(const FrameStore& frames, const LoopLedger& loops,
                                const std::vector<ViewTie>& ties, const Vec3& up) {
  HeightCorrection correction{std::vector<double>(frames.size(), 0.), 0.5};
  const std::vector<Rise> rises = RisesOf(frames, loops, ties, up);
  if (rises.empty()) return correction;
  const std::vector<int> points = PointsOf(frames, rises);
  std::map<int, int> point_of_frame;
  for (std::size_t k = 0; k < points.size(); ++k) point_of_frame[points[k]] = static_cast<int>(k);
  std::vector<double> lengths;
  for (std::size_t k = 1; k < points.size(); ++k)
    lengths.push_back(IsLost(frames, points[k])
                          ? std::numeric_limits<double>::infinity()
                          : PathAt(frames, points[k]) - PathAt(frames, points[k - 1]));
  std::vector<WalkDifference> measured;
  for (const Rise& rise : rises) {
    const Vec3 by_odometry =
        frames[rise.to].T_input_cam.translation() - frames[rise.from].T_input_cam.translation();
    measured.push_back({point_of_frame[rise.from], point_of_frame[rise.to],
                        rise.metres - up.dot(by_odometry), rise.sigma});
  }
  const RandomWalk walk(lengths, std::move(measured));
  const std::vector<Share> shares = SharesOf(frames, points);
  Eigen::VectorXd change(frames.size());
  for (int f = 0; f < frames.size(); ++f) {
    const auto& [k, share] = shares[f];
    change[f] = correction.rise_m[f] = (1 - share) * walk.mean()[k] + share * walk.mean()[k + 1];
  }
  for (std::size_t k = 0; k < frames.parts().size(); ++k) {  // odometry does not place a part
    const int from = frames.parts()[k];
    auto part = change.segment(from, frames.EndOfPart(static_cast<int>(k)) - from);
    part.array() -= part.mean();
  }
  Eigen::VectorXd at_points = Eigen::VectorXd::Zero(walk.mean().size());
  for (int f = 0; f < frames.size(); ++f) {
    const auto& [k, share] = shares[f];
    at_points[k] += (1 - share) * change[f];
    at_points[k + 1] += share * change[f];
  }
  correction.probability = ProbabilityNearer(change.squaredNorm(), walk.VarianceAlong(at_points));
  return correction;
}

}  // namespace sslcd
