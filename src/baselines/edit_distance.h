// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/answer.h"
#include "baselines/label_walks.h"

namespace sslcd::baselines {

/// A neighbour of an object: its label and distance. All neighbours are the object's neighbourhood.
struct Spoke {
  int label = 0;
  double length_m = 0;
};
std::vector<Spoke> SpokesOf(const std::vector<LayoutObject>& objects, const LabelGraph& graph,
                            int vertex);

/// The edit distance of two neighbourhoods by assignment (Riesen and Bunke 2009, exact for stars).
/// Adding or removing a spoke costs 1. Keeping a spoke of the same label costs 0, or with
/// `edge_tolerance_m` > 0 up to 2 in proportion to the difference of the lengths; it reaches 2 at
/// the tolerance.
double StarEditDistance(const std::vector<Spoke>& a, const std::vector<Spoke>& b,
                        double edge_tolerance_m);

/// 1 - distance / (number of spokes of both), in [0, 1]; 0 if both have none.
double StarSimilarity(const std::vector<Spoke>& a, const std::vector<Spoke>& b,
                      double edge_tolerance_m);

/// The graph around a match consists of the matched vertices and their neighbours. 1 - edit
/// distance / size of the smaller one = (matched vertices + edges between them that both have) /
/// (vertices + edges of the smaller one), in [0, 1]. Additional parts of the larger graph and more
/// distant parts cost nothing, since maps overlap only partially. Matches are one to one.
double GraphSimilarity(const LabelGraph& local, const LabelGraph& global,
                       const ObjectPairs& matches);

}  // namespace sslcd::baselines
