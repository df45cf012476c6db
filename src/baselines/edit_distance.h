// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/answer.h"
#include "baselines/label_walks.h"

namespace sslcd::baselines {

/// A neighbour as seen from an object: what it is, and how far away. Together they are the object's
/// neighbourhood.
struct Spoke {
  int label = 0;
  double length_m = 0;
};
std::vector<Spoke> SpokesOf(const std::vector<LayoutObject>& objects, const LabelGraph& graph,
                            int vertex);

/// The cheapest way from one neighbourhood to the other, found by assignment (Riesen and Bunke
/// 2009, exact for stars). To add or remove a spoke costs 1. To keep one costs 0, and where lengths
/// count (`edge_tolerance_m` > 0) up to 2, which is reached where they differ by that much. Spokes
/// of different labels are not kept.
double StarEditDistance(const std::vector<Spoke>& a, const std::vector<Spoke>& b,
                        double edge_tolerance_m);

/// 1 - distance / (number of spokes of both), in [0, 1]; 0 where neither has any.
double StarSimilarity(const std::vector<Spoke>& a, const std::vector<Spoke>& b,
                      double edge_tolerance_m);

/// The graphs round a match are each that of the matched vertices and their neighbours. 1 - edit
/// distance / size of the smaller one = (matched vertices + edges between them that both have) /
/// (vertices + edges of the smaller one), in [0, 1]. What only the larger has costs nothing, and
/// what lies further away does not count, since maps overlap in part. Matches are one to one.
double GraphSimilarity(const LabelGraph& local, const LabelGraph& global,
                       const ObjectPairs& matches);

}  // namespace sslcd::baselines
