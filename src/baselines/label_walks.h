// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <random>
#include <vector>

#include "sslcd/core/fields.h"
#include "sslcd/core/layout.h"

namespace sslcd::baselines {

/// The object graph of these methods: a vertex with a label per object, and an edge between any two
/// that are at most `edge_m` apart.
struct LabelGraph {
  std::vector<int> labels;
  std::vector<std::vector<int>> neighbours;  ///< of each vertex, ascending
};
/// An object whose position is not finite has no neighbours. O(n^2).
LabelGraph MakeLabelGraph(const std::vector<LayoutObject>& objects, double edge_m);

/// Counts of the label sequences of walks from one vertex; a sequence starts with the vertex.
using LabelWalks = std::map<std::vector<int>, int>;

struct RandomWalkOptions {
  int walks = 400;  ///< from each vertex
  int steps = 3;    ///< of each walk
};
void DescribeFields(FieldVisitor& visitor, RandomWalkOptions& options);

/// Random walks from each vertex. All neighbours are equally likely, including the previous vertex.
/// A vertex without neighbours keeps the walk.
std::vector<LabelWalks> RandomWalks(const LabelGraph& graph, const RandomWalkOptions& options,
                                    std::mt19937_64& random);

/// All walks of `steps` steps from each vertex instead of a sample. A vertex without neighbours has
/// none. Memory and time grow with degree^steps.
std::vector<LabelWalks> AllWalks(const LabelGraph& graph, int steps);

/// The share of common walks of two vertices, in [0, 1]: sum of min(count) divided by the larger
/// number of walks.
double CommonShare(const LabelWalks& a, const LabelWalks& b);

/// Cosine of the angle between two vectors of counts, in [0, 1]; 0 if one is empty.
double Cosine(const LabelWalks& a, const LabelWalks& b);

}  // namespace sslcd::baselines
