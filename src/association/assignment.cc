// SPDX-License-Identifier: BSD-3-Clause
#include "association/assignment.h"

#include <cassert>
#include <limits>

namespace sslcd {
namespace {

// Every row gets a dummy column at cost 0, so that it can stay unassigned, which is never worse
// than a forbidden pair.
class Costs {
 public:
  explicit Costs(const Eigen::MatrixXd& scores) : scores_(scores) {}
  int rows() const { return static_cast<int>(scores_.rows()); }
  int real_columns() const { return static_cast<int>(scores_.cols()); }
  int columns() const { return real_columns() + rows(); }
  double operator()(int row, int column) const {
    if (column >= real_columns()) return column - real_columns() == row ? 0. : kForbidden;
    assert(scores_(row, column) == scores_(row, column));
    return scores_(row, column) > 0 ? -scores_(row, column) : kForbidden;
  }

 private:
  static constexpr double kForbidden = 1;  // more than the dummy costs: never part of a minimum
  const Eigen::MatrixXd& scores_;
};

// Rows matched so far, with potentials u and v such that c_ij - u_i - v_j >= 0, and = 0 where i and
// j are matched. Rows and columns count from 1: index 0 is a sentinel.
struct Matching {
  explicit Matching(const Costs& costs)
      : row_potential(costs.rows() + 1),
        column_potential(costs.columns() + 1),
        row_of(costs.columns() + 1),
        previous(costs.columns() + 1) {}
  std::vector<double> row_potential, column_potential;
  std::vector<int> row_of;    // of a column; 0: free
  std::vector<int> previous;  // column before it on the shortest path
};

// Dijkstra's algorithm over reduced costs c_ij - u_i - v_j, from a row that is not matched yet to
// the nearest free column, which it returns. Updates the potentials by the distances.
int FindFreeColumn(const Costs& cost, int row, Matching& matching) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const int columns = cost.columns();
  std::vector<double> distance(columns + 1, kInfinity);
  std::vector<bool> done(columns + 1, false);
  matching.row_of[0] = row;
  int column = 0;
  do {
    done[column] = true;
    const int current = matching.row_of[column];
    double step = kInfinity;
    int next = 0;
    for (int j = 1; j <= columns; ++j) {
      if (done[j]) continue;
      const double reduced =
          cost(current - 1, j - 1) - matching.row_potential[current] - matching.column_potential[j];
      if (reduced < distance[j]) {
        distance[j] = reduced;
        matching.previous[j] = column;
      }
      if (distance[j] < step) {
        step = distance[j];
        next = j;
      }
    }
    for (int j = 0; j <= columns; ++j) {
      if (done[j]) {
        matching.row_potential[matching.row_of[j]] += step;
        matching.column_potential[j] -= step;
      } else {
        distance[j] -= step;
      }
    }
    column = next;
  } while (matching.row_of[column] != 0);
  return column;
}

// Gives each column of the path to the row of the column before it: one more row is matched.
void FlipPath(int column, Matching& matching) {
  while (column != 0) {
    matching.row_of[column] = matching.row_of[matching.previous[column]];
    column = matching.previous[column];
  }
}

}  // namespace

// The Hungarian method by shortest augmenting paths (Jonker and Volgenant, Computing 38, 1987).
std::vector<int> MaximumAssignment(const Eigen::MatrixXd& scores) {
  if (scores.rows() > scores.cols()) {  // the time grows with the square of the rows
    std::vector<int> column_of(static_cast<std::size_t>(scores.rows()), -1);
    const std::vector<int> row_of = MaximumAssignment(scores.transpose());
    for (std::size_t j = 0; j < row_of.size(); ++j)
      if (row_of[j] >= 0) column_of[static_cast<std::size_t>(row_of[j])] = static_cast<int>(j);
    return column_of;
  }
  const Costs costs(scores);
  Matching matching(costs);
  for (int row = 1; row <= costs.rows(); ++row)
    FlipPath(FindFreeColumn(costs, row, matching), matching);

  std::vector<int> column_of(costs.rows(), -1);
  for (int j = 1; j <= costs.real_columns(); ++j) {
    const int row = matching.row_of[j];
    if (row > 0) column_of[row - 1] = j - 1;
  }
  return column_of;
}

}  // namespace sslcd
