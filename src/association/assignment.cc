// SPDX-License-Identifier: BSD-3-Clause
#include "association/assignment.h"

#include <cassert>
#include <limits>

namespace sslcd {

std::vector<int> MaximumAssignment(const Eigen::MatrixXd& scores) {
  const int rows = static_cast<int>(scores.rows());
  const int real_columns = static_cast<int>(scores.cols());
  // Every row gets a dummy column of its own at score 0: "stays alone" is then always possible, and
  // never worse than a forbidden pair.
  const int columns = real_columns + rows;
  const auto cost = [&](int row, int column) {
    if (column < real_columns) {
      assert(scores(row, column) == scores(row, column));
      return scores(row, column) > 0 ? -scores(row, column) : 1.;
    }
    return column - real_columns == row ? 0. : 1.;
  };

  // Shortest augmenting paths with potentials; index 0 of the arrays is a sentinel, rows and
  // columns count from 1.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> row_potential(rows + 1, 0.), column_potential(columns + 1, 0.);
  std::vector<int> row_of(columns + 1, 0), previous(columns + 1, 0);
  for (int row = 1; row <= rows; ++row) {
    std::vector<double> distance(columns + 1, kInfinity);
    std::vector<bool> done(columns + 1, false);
    row_of[0] = row;
    int column = 0;
    do {
      done[column] = true;
      const int current = row_of[column];
      double step = kInfinity;
      int next = 0;
      for (int j = 1; j <= columns; ++j) {
        if (done[j]) continue;
        const double reduced =
            cost(current - 1, j - 1) - row_potential[current] - column_potential[j];
        if (reduced < distance[j]) {
          distance[j] = reduced;
          previous[j] = column;
        }
        if (distance[j] < step) {
          step = distance[j];
          next = j;
        }
      }
      for (int j = 0; j <= columns; ++j) {
        if (done[j]) {
          row_potential[row_of[j]] += step;
          column_potential[j] -= step;
        } else {
          distance[j] -= step;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    while (column != 0) {  // flip the path
      row_of[column] = row_of[previous[column]];
      column = previous[column];
    }
  }

  std::vector<int> column_of(rows, -1);
  for (int j = 1; j <= real_columns; ++j) {
    if (row_of[j] > 0 && scores(row_of[j] - 1, j - 1) > 0) column_of[row_of[j] - 1] = j - 1;
  }
  return column_of;
}

}  // namespace sslcd
