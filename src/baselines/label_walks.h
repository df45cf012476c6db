// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <random>
#include <vector>

#include "sslcd/core/fields.h"
#include "sslcd/core/layout.h"

namespace sslcd::baselines {

/// Objects as the graph that all of these methods start from: a vertex per object, of which only
/// the label counts, and an edge between any two that are at most `edge_m` apart.
struct LabelGraph {
  std::vector<int> labels;
  std::vector<std::vector<int>> neighbours;  ///< of each vertex, ascending
};
/// An object whose position is not finite has no neighbours. O(n^2).
LabelGraph MakeLabelGraph(const std::vector<LayoutObject>& objects, double edge_m);

/// The labels along walks from one vertex, itself first, and how many walks have read them.
using LabelWalks = std::map<std::vector<int>, int>;

struct RandomWalkOptions {
  int walks = 400;  ///< from each vertex
  int steps = 3;    ///< of each walk
};
void DescribeFields(FieldVisitor& visitor, RandomWalkOptions& options);

/// Random walks from each vertex; every neighbour is as likely as the others, the one just left
/// too. Where there is none, the walk stays.
std::vector<LabelWalks> RandomWalks(const LabelGraph& graph, const RandomWalkOptions& options,
                                    std::mt19937_64& random);

/// All walks of `steps` steps from each vertex, in place of a sample. A vertex without neighbours
/// has none. Memory and time grow with degree^steps.
std::vector<LabelWalks> AllWalks(const LabelGraph& graph, int steps);

/// The share of walks that two vertices have in common, in [0, 1]: sum of min(count) over the
/// larger number of walks.
double CommonShare(const LabelWalks& a, const LabelWalks& b);

/// Cosine of the angle between two vectors of counts, in [0, 1]; 0 where one is empty.
double Cosine(const LabelWalks& a, const LabelWalks& b);

}  // namespace sslcd::baselines
