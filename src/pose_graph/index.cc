// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/index.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <numeric>
#include <unordered_map>

namespace sslcd {
namespace {

bool Finite(const Pose& T) {
  for (int i = 0; i < 7; ++i)
    if (!std::isfinite(T.data()[i])) return false;
  return true;
}

std::string Name(const PoseGraph::Edge& edge) {
  return "edge " + std::to_string(edge.from) + " -> " + std::to_string(edge.to);
}

}  // namespace

PoseGraphIndex IndexPoseGraph(const PoseGraph& graph) {
  PoseGraphIndex index;
  std::unordered_map<int, int> position;
  for (const PoseGraph::Vertex& vertex : graph.vertices) {
    if (!position.emplace(vertex.id, static_cast<int>(position.size())).second) {
      index.trouble = "vertex " + std::to_string(vertex.id) + " is there twice";
      return index;
    }
    if (!Finite(vertex.T_world_vertex)) {
      index.trouble = "vertex " + std::to_string(vertex.id) + " holds NaN or infinite values";
      return index;
    }
  }
  for (const PoseGraph::Edge& edge : graph.edges) {
    const auto from = position.find(edge.from), to = position.find(edge.to);
    if (from == position.end() || to == position.end()) {
      index.trouble = Name(edge) + " leads to a vertex that is not there";
    } else if (from == to) {
      index.trouble = Name(edge) + " leads back to its own vertex";
    } else if (!Finite(edge.T_from_to) || !edge.information.allFinite()) {
      index.trouble = Name(edge) + " holds NaN or infinite values";
    } else if (Eigen::LLT<Eigen::Matrix<double, 6, 6>>(edge.information).info() != Eigen::Success) {
      index.trouble = Name(edge) + " has an information matrix that is not positive definite";
    }
    if (!index.trouble.empty()) return index;
    index.ends.emplace_back(from->second, to->second);
  }
  return index;
}

std::vector<int> Components(int vertices, const std::vector<std::pair<int, int>>& ends,
                            const std::vector<bool>& use) {
  std::vector<int> root(vertices);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (!use.empty() && !use[i]) continue;
    const int a = find(ends[i].first), b = find(ends[i].second);
    root[std::max(a, b)] = std::min(a, b);  // the root is the first vertex of the component
  }
  std::vector<int> component(vertices);
  for (int i = 0, count = 0; i < vertices; ++i)
    component[i] = find(i) == i ? count++ : component[find(i)];
  return component;
}

}  // namespace sslcd
