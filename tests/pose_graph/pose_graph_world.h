// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <vector>

#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// A course driven several times, with odometry that drifts, true loops back to earlier laps and
/// false ones to anywhere.
struct PoseGraphWorld {
  PoseGraph graph;  ///< vertices by odometry; ids 0, 1, 2, ...
  std::vector<Pose> truth;
  std::vector<bool> is_false;  ///< per edge
};

struct PoseGraphWorldOptions {
  unsigned seed = 1;
  int keyframes = 900, laps = 3, loops = 60, false_loops = 0;
  double step_m = 1;
  double step_sigma_m = 0.05, step_sigma_rad = 0.003;  ///< of odometry, per step and axis
  double loop_sigma_m = 0.1, loop_sigma_rad = 0.01;
};

/// Measurement noise with its information.
class PoseNoise {
 public:
  explicit PoseNoise(unsigned seed) : engine_(seed) {}
  double Uniform(double low, double high) {
    return low + (high - low) * ((engine_() + 0.5) / 4294967296.);
  }
  double Normal() {
    return std::sqrt(-2 * std::log(Uniform(0, 1))) * std::cos(Uniform(0, 2 * M_PI));
  }

  PoseGraph::Edge Measure(int from, int to, const Pose& T_from_to, double sigma_m,
                          double sigma_rad) {
    Vec6 sigma, error;
    sigma << sigma_m, sigma_m, sigma_m, sigma_rad, sigma_rad, sigma_rad;
    for (int i = 0; i < 6; ++i) error[i] = sigma[i] * Normal();
    PoseGraph::Edge edge;
    edge.from = from;
    edge.to = to;
    edge.T_from_to = T_from_to * Pose::Exp(error);
    edge.information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
    return edge;
  }

 private:
  std::mt19937 engine_;
};

/// A square with round corners; z is up.
inline PoseGraphWorld MakePoseGraphWorld(const PoseGraphWorldOptions& o) {
  PoseNoise noise(o.seed);
  PoseGraphWorld world;
  const int per_lap = o.keyframes / o.laps, side = per_lap / 4, corner = side / 5;
  const auto drive = [&](int i) {  // half of each lap's start is straight, so laps join smoothly
    const double turn = i % side < corner ? M_PI / 2 / corner : 0;
    return Pose(lie::SO3<double>::RotZ(turn), Vec3(o.step_m, 0, 0));
  };
  Pose T;
  for (int i = 0; i < o.keyframes; ++i) {
    world.truth.push_back(T);
    T = T * drive(i);
  }
  const auto add = [&](PoseGraph::Edge edge, bool loop, bool is_false) {
    edge.loop = loop;
    world.graph.edges.push_back(edge);
    world.is_false.push_back(is_false);
  };
  const auto truth = [&](int i, int j) { return world.truth[i].inverse() * world.truth[j]; };
  for (int i = 0; i + 1 < o.keyframes; ++i)
    add(noise.Measure(i, i + 1, truth(i, i + 1), o.step_sigma_m, o.step_sigma_rad), false, false);
  for (int k = 0; k < o.loops; ++k) {
    const int to = per_lap + static_cast<int>(noise.Uniform(0, o.keyframes - per_lap));
    const int from = to % per_lap + static_cast<int>(noise.Uniform(0, to / per_lap)) * per_lap;
    add(noise.Measure(from, to, truth(from, to), o.loop_sigma_m, o.loop_sigma_rad), true, false);
  }
  for (int k = 0; k < o.false_loops; ++k) {
    const int to = per_lap + static_cast<int>(noise.Uniform(0, o.keyframes - per_lap));
    const int from = static_cast<int>(noise.Uniform(0, to - per_lap / 2.));
    const Pose somewhere(lie::SO3<double>::RotZ(noise.Uniform(-M_PI, M_PI)),
                         Vec3(noise.Uniform(-5, 5), noise.Uniform(-5, 5), 0));
    add(noise.Measure(from, to, somewhere, o.loop_sigma_m, o.loop_sigma_rad), true, true);
  }
  world.graph.vertices.push_back({0, Pose()});
  for (int i = 0; i + 1 < o.keyframes; ++i)
    world.graph.vertices.push_back(
        {i + 1, world.graph.vertices[i].T_world_vertex * world.graph.edges[i].T_from_to});
  return world;
}

/// RMSE of the positions after the best rigid alignment.
inline double AteRmse(const PoseGraph& estimate, const std::vector<Pose>& truth) {
  const auto count = static_cast<Eigen::Index>(truth.size());
  Eigen::Matrix3Xd p(3, count), q(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    p.col(i) = estimate.vertices[i].T_world_vertex.translation();
    q.col(i) = truth[i].translation();
  }
  const Eigen::Matrix4d T = Eigen::umeyama(p, q, false);
  return std::sqrt(
      ((T.topLeftCorner<3, 3>() * p).colwise() + T.topRightCorner<3, 1>() - q).squaredNorm() /
      static_cast<double>(count));
}

}  // namespace sslcd
