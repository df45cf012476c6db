// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/edit_distance.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "association/assignment.h"

namespace sslcd::baselines {
namespace {

bool Adjacent(const LabelGraph& graph, int a, int b) {
  return std::binary_search(graph.neighbours[a].begin(), graph.neighbours[a].end(), b);
}

// Number of vertices and edges of the graph of these vertices and their neighbours.
int SizeAround(const LabelGraph& graph, const std::vector<int>& vertices) {
  std::set<int> around(vertices.begin(), vertices.end());
  for (const int vertex : vertices)
    around.insert(graph.neighbours[vertex].begin(), graph.neighbours[vertex].end());
  int ends = 0;
  for (const int vertex : around)
    for (const int other : graph.neighbours[vertex]) ends += static_cast<int>(around.count(other));
  return static_cast<int>(around.size()) + ends / 2;
}

}  // namespace

std::vector<Spoke> SpokesOf(const std::vector<LayoutObject>& objects, const LabelGraph& graph,
                            int vertex) {
  std::vector<Spoke> spokes;
  for (const int other : graph.neighbours[vertex])
    spokes.push_back(
        {objects[other].label, (objects[other].position - objects[vertex].position).norm()});
  return spokes;
}

double StarEditDistance(const std::vector<Spoke>& a, const std::vector<Spoke>& b,
                        double edge_tolerance_m) {
  // Saving of keeping a spoke instead of removing and adding it.
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

double StarSimilarity(const std::vector<Spoke>& a, const std::vector<Spoke>& b,
                      double edge_tolerance_m) {
  if (a.empty() && b.empty()) return 0;
  return 1 - StarEditDistance(a, b, edge_tolerance_m) / static_cast<double>(a.size() + b.size());
}

double GraphSimilarity(const LabelGraph& local, const LabelGraph& global,
                       const ObjectPairs& matches) {
  std::vector<int> of_local, of_global;
  int common_edges = 0;
  for (std::size_t a = 0; a < matches.size(); ++a) {
    of_local.push_back(matches[a].first);
    of_global.push_back(matches[a].second);
    for (std::size_t b = 0; b < a; ++b)
      common_edges += Adjacent(local, matches[a].first, matches[b].first) &&
                      Adjacent(global, matches[a].second, matches[b].second);
  }
  const int smaller = std::min(SizeAround(local, of_local), SizeAround(global, of_global));
  return smaller == 0 ? 0 : (static_cast<double>(matches.size()) + common_edges) / smaller;
}

}  // namespace sslcd::baselines
