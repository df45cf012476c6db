// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "pose_graph_world.h"

namespace sslcd {

struct TorusOptions {
  unsigned seed = 1;
  int rings = 20, per_ring = 25;
  double step_m = 1, sigma_m = 0.05, sigma_rad = 0.02;
  double indefinite_share = 0;  ///< of the edges
};

/// A path that winds round a torus, as in the public graph torus3D: each pose is joined to the next
/// one and to its neighbour on the next ring. Indefinite edges have a cross term between z and roll
/// that is too large for their diagonal.
struct TorusWorld {
  PoseGraph graph;  ///< vertices by odometry
  std::vector<Pose> truth;
  int indefinite = 0;  ///< edges
};

inline TorusWorld MakeTorus(const TorusOptions& o) {
  const int count = o.rings * o.per_ring;
  const double tube_m = o.step_m * o.per_ring / (2 * M_PI);
  const double torus_m = tube_m + o.step_m * o.rings / (2 * M_PI);
  TorusWorld world;
  for (int i = 0; i < count; ++i) {
    const lie::SO3<double> about_axis = lie::SO3<double>::RotZ(2 * M_PI * i / count);
    const lie::SO3<double> about_tube = lie::SO3<double>::RotY(2 * M_PI * i / o.per_ring);
    const Vec3 on_tube = Vec3(torus_m, 0, 0) + about_tube * Vec3(tube_m, 0, 0);
    world.truth.push_back(Pose(about_axis * about_tube, about_axis * on_tube));
  }
  PoseNoise noise(o.seed);
  const auto add = [&](int from, int to) {
    PoseGraph::Edge edge = noise.Measure(from, to, world.truth[from].inverse() * world.truth[to],
                                         o.sigma_m, o.sigma_rad);
    edge.loop = to != from + 1;
    const double excess = noise.Uniform(1.1, 2);
    if (noise.Uniform(0, 1) < o.indefinite_share) {
      edge.information(2, 3) = edge.information(3, 2) =
          excess * std::sqrt(edge.information(2, 2) * edge.information(3, 3));
      ++world.indefinite;
    }
    world.graph.edges.push_back(edge);
  };
  for (int i = 0; i + 1 < count; ++i) add(i, i + 1);
  for (int i = 0; i < count; ++i) add(i, (i + o.per_ring) % count);
  world.graph.vertices.push_back({0, world.truth[0]});
  for (int i = 0; i + 1 < count; ++i)
    world.graph.vertices.push_back(
        {i + 1, world.graph.vertices[i].T_world_vertex * world.graph.edges[i].T_from_to});
  return world;
}

}  // namespace sslcd
