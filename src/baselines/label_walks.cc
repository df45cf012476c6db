// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/label_walks.h"

#include <algorithm>
#include <cmath>

namespace sslcd::baselines {
namespace {

int Total(const LabelWalks& walks) {
  int total = 0;
  for (const auto& [labels, count] : walks) total += count;
  return total;
}

// Sum of `combine`(count in a, count in b) over the common entries.
template <class Combine>
double SumCommon(const LabelWalks& a, const LabelWalks& b, Combine combine) {
  double sum = 0;
  for (const auto& [labels, count] : a) {
    const auto other = b.find(labels);
    if (other != b.end()) sum += combine(count, other->second);
  }
  return sum;
}

double Product(double a, double b) { return a * b; }

void ExtendWalks(const LabelGraph& graph, int vertex, int steps, std::vector<int>& labels,
                 LabelWalks& walks) {
  labels.push_back(graph.labels[vertex]);
  if (steps == 0) ++walks[labels];
  if (steps > 0)
    for (const int next : graph.neighbours[vertex])
      ExtendWalks(graph, next, steps - 1, labels, walks);
  labels.pop_back();
}

}  // namespace

LabelGraph MakeLabelGraph(const std::vector<LayoutObject>& objects, double edge_m) {
  LabelGraph graph;
  graph.neighbours.resize(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    graph.labels.push_back(objects[i].label);
    for (std::size_t j = 0; j < objects.size(); ++j)
      if (i != j && (objects[i].position - objects[j].position).norm() <= edge_m)
        graph.neighbours[i].push_back(static_cast<int>(j));
  }
  return graph;
}

void DescribeFields(FieldVisitor& visitor, RandomWalkOptions& options) {
  visitor.Integer("walks", options.walks, 1, 100000, "random walks from each object");
  visitor.Integer("steps", options.steps, 1, 20, "steps of each walk");
}

std::vector<LabelWalks> RandomWalks(const LabelGraph& graph, const RandomWalkOptions& options,
                                    std::mt19937_64& random) {
  std::vector<LabelWalks> walks(graph.labels.size());
  for (std::size_t v = 0; v < walks.size(); ++v) {
    for (int walk = 0; walk < options.walks; ++walk) {
      std::size_t at = v;
      std::vector<int> labels{graph.labels[at]};
      for (int step = 0; step < options.steps; ++step) {
        const std::vector<int>& next = graph.neighbours[at];
        if (!next.empty()) at = next[random() % next.size()];
        labels.push_back(graph.labels[at]);
      }
      ++walks[v][labels];
    }
  }
  return walks;
}

std::vector<LabelWalks> AllWalks(const LabelGraph& graph, int steps) {
  std::vector<LabelWalks> walks(graph.labels.size());
  std::vector<int> labels;
  for (std::size_t v = 0; v < walks.size(); ++v)
    ExtendWalks(graph, static_cast<int>(v), steps, labels, walks[v]);
  return walks;
}

double CommonShare(const LabelWalks& a, const LabelWalks& b) {
  const int total = std::max(Total(a), Total(b));
  return total == 0 ? 0 : SumCommon(a, b, [](int x, int y) { return std::min(x, y); }) / total;
}

double Cosine(const LabelWalks& a, const LabelWalks& b) {
  const double squares = SumCommon(a, a, Product) * SumCommon(b, b, Product);
  return squares == 0 ? 0 : SumCommon(a, b, Product) / std::sqrt(squares);
}

}  // namespace sslcd::baselines
