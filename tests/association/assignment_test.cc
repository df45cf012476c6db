// SPDX-License-Identifier: BSD-3-Clause
#include "association/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace sslcd {
namespace {

double Total(const Eigen::MatrixXd& scores, const std::vector<int>& column_of) {
  double sum = 0;
  for (std::size_t row = 0; row < column_of.size(); ++row)
    if (column_of[row] >= 0) sum += scores(row, column_of[row]);
  return sum;
}

// Tries every way to give each row one free column or none.
double Exhaustive(const Eigen::MatrixXd& scores, int row, std::vector<bool>& taken) {
  if (row == scores.rows()) return 0;
  double best = Exhaustive(scores, row + 1, taken);
  for (int column = 0; column < scores.cols(); ++column) {
    if (taken[column] || scores(row, column) <= 0) continue;
    taken[column] = true;
    best = std::max(best, scores(row, column) + Exhaustive(scores, row + 1, taken));
    taken[column] = false;
  }
  return best;
}

TEST(MaximumAssignment, ReachesTheExhaustiveOptimumOnRandomMatrices) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const int rows = 1 + random() % 5, columns = 1 + random() % 5;
    Eigen::MatrixXd scores(rows, columns);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j)
        scores(i, j) = int(random() % 100) / 50. - 1.;  // half of them forbidden
    const std::vector<int> answer = MaximumAssignment(scores);
    std::vector<bool> taken(columns, false);
    EXPECT_NEAR(Total(scores, answer), Exhaustive(scores, 0, taken), 1e-12);
    std::vector<int> used;
    for (const int column : answer)
      if (column >= 0) used.push_back(column);
    std::sort(used.begin(), used.end());
    EXPECT_EQ(std::unique(used.begin(), used.end()), used.end()) << "a column was given away twice";
    for (int i = 0; i < rows; ++i)
      EXPECT_TRUE(answer[i] < 0 || scores(i, answer[i]) > 0) << "a forbidden pair was matched";
  }
}

TEST(MaximumAssignment, GivesUpTheBestPairWhereTheSumIsLarger) {
  Eigen::MatrixXd scores(2, 2);
  scores << .9, .8, .8, .0;
  EXPECT_EQ(MaximumAssignment(scores), (std::vector<int>{1, 0}));
}

// A frame with a flood of false detections; with the square of the rows this takes minutes.
TEST(MaximumAssignment, TakesManyRows) {
  constexpr int kRows = 30000;
  Eigen::MatrixXd scores = Eigen::MatrixXd::Constant(kRows, 3, 0.25);
  scores(29000, 0) = scores(7, 1) = scores(12345, 2) = 1;
  const std::vector<int> column_of = MaximumAssignment(scores);
  EXPECT_EQ(column_of[29000], 0);
  EXPECT_EQ(column_of[7], 1);
  EXPECT_EQ(column_of[12345], 2);
  EXPECT_EQ(std::count(column_of.begin(), column_of.end(), -1), kRows - 3);
}

TEST(MaximumAssignment, EmptyAndForbiddenInput) {
  EXPECT_TRUE(MaximumAssignment(Eigen::MatrixXd(0, 3)).empty());
  EXPECT_EQ(MaximumAssignment(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
  EXPECT_EQ(MaximumAssignment(Eigen::MatrixXd::Zero(2, 2)), (std::vector<int>{-1, -1}));
}

}  // namespace
}  // namespace sslcd
