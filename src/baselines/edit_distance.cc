// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/baselines/edit_distance.h"

#include <algorithm>
#include <cmath>

#include "sslcd/association/assignment.h"

namespace sslcd::baselines {
namespace {

bool Adjacent(const LabelGraph& graph, int a, int b) {
  return std::binary_search(graph.neighbours[a].begin(), graph.neighbours[a].end(), b);
}

int CountEdges(const LabelGraph& graph) {
  std::size_t ends = 0;
  for (const std::vector<int>& neighbours : graph.neighbours) ends += neighbours.size();
  return static_cast<int>(ends / 2);
}

}  // namespace

std::vector<Spoke> SpokesOf(const std::vector<LayoutObject>& objects, const LabelGraph& graph, int vertex) {
  std::vector<Spoke> spokes;
  for (const int other : graph.neighbours[vertex])
    spokes.push_back({objects[other].label, (objects[other].position - objects[vertex].position).norm()});
  return spokes;
}

double StarEditDistance(const std::vector<Spoke>& a, const std::vector<Spoke>& b, double edge_tolerance_m) {
  // What keeping a spoke saves over removing and adding it.
  Eigen::MatrixXd saved = Eigen::MatrixXd::Zero(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (a[i].label != b[j].label) continue;
      const double off_m = std::abs(a[i].length_m - b[j].length_m);
      saved(i, j) = edge_tolerance_m > 0 ? 2 * std::max(0., 1 - off_m / edge_tolerance_m) : 2;
    }
  }
  double distance = static_cast<double>(a.size() + b.size());
  const std::vector<int> kept = MaximumAssignment(saved);
  for (std::size_t i = 0; i < a.size(); ++i)
    if (kept[i] >= 0) distance -= saved(i, kept[i]);
  return distance;
}

double StarSimilarity(const std::vector<Spoke>& a, const std::vector<Spoke>& b, double edge_tolerance_m) {
  if (a.empty() && b.empty()) return 0;
  return 1 - StarEditDistance(a, b, edge_tolerance_m) / static_cast<double>(a.size() + b.size());
}

double GraphSimilarity(const LabelGraph& local, const LabelGraph& global, const ObjectPairs& matches) {
  int global_edges = 0, common_edges = 0;  // among matched vertices
  for (std::size_t a = 0; a < matches.size(); ++a) {
    for (std::size_t b = a + 1; b < matches.size(); ++b) {
      const bool in_local = Adjacent(local, matches[a].first, matches[b].first);
      const bool in_global = Adjacent(global, matches[a].second, matches[b].second);
      global_edges += in_global;
      common_edges += in_local && in_global;
    }
  }
  const int vertices = static_cast<int>(local.labels.size()), matched = static_cast<int>(matches.size());
  const int all_local_edges = CountEdges(local);
  const int all = vertices + matched + all_local_edges + global_edges;
  const int edits = vertices - matched + all_local_edges + global_edges - 2 * common_edges;
  return all == 0 ? 0 : 1 - static_cast<double>(edits) / all;
}

}  // namespace sslcd::baselines
