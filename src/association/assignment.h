// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sslcd {

/// One-to-one assignment of rows to columns that maximises the sum of `scores` (Hungarian algorithm
/// in the shortest-augmenting-path form, Jonker and Volgenant 1987; O(n^2 m) with the smaller n of
/// rows and columns and the larger m). Entries <= 0 are forbidden pairs; a row may stay unassigned.
/// Returns the column of each row, -1 for none. Deterministic. Scores must be finite.
std::vector<int> MaximumAssignment(const Eigen::MatrixXd& scores);

}  // namespace sslcd
