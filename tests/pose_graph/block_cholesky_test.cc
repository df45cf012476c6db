// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/block_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

namespace sslcd {
namespace {

using Block = BlockCholesky::Block;
using Pairs = std::vector<std::pair<int, int>>;

// The same matrix sparse and dense: positive definite by its diagonal.
struct Both {
  BlockCholesky sparse;
  Eigen::MatrixXd dense;

  Both(int unknowns, const Pairs& pairs, unsigned seed)
      : sparse(unknowns, pairs), dense(Eigen::MatrixXd::Zero(6 * unknowns, 6 * unknowns)) {
    std::mt19937 random(seed);
    const auto any = [&random] {
      Block block;
      for (double& entry : block.reshaped())
        entry = static_cast<double>(random() % 2001) * 1e-3 - 1;
      return block;
    };
    for (int i = 0; i < unknowns; ++i) {
      const Block root = any();
      Add(i, i, root * root.transpose() + 100 * Block::Identity());
    }
    for (const auto& [a, b] : pairs)
      if (a != b) Add(a, b, any());
  }

  void Add(int row, int column, const Block& block) {
    sparse.Add(row, column, block);
    dense.block<6, 6>(6 * row, 6 * column) += block;
    if (row != column) dense.block<6, 6>(6 * column, 6 * row) += block.transpose();
  }
};

template <int Columns>
void ExpectSolves(const BlockCholesky& factor, const Eigen::MatrixXd& dense) {
  const int unknowns = static_cast<int>(dense.rows()) / 6;
  const Eigen::MatrixXd b = Eigen::MatrixXd::Identity(6 * unknowns, Columns).array() + 0.5;
  BlockCholesky::Vector<Columns> blocks(unknowns);
  for (int i = 0; i < unknowns; ++i) blocks[i] = b.middleRows<6>(6 * i);
  const BlockCholesky::Vector<Columns> x = factor.Solve(blocks);
  const Eigen::MatrixXd expected = dense.llt().solve(b);
  for (int i = 0; i < unknowns; ++i)
    EXPECT_TRUE(x[i].isApprox(expected.middleRows<6>(6 * i), 1e-9)) << "unknown " << i;
}

TEST(BlockCholesky, SolvesAsADenseMatrixDoes) {
  const Pairs chain_with_loops{{0, 1}, {2, 1}, {2, 3}, {4, 3}, {0, 4}, {4, 1}, {1, 0}};
  Pairs star, random_pairs;
  for (int i = 1; i < 12; ++i) star.push_back({0, i});
  std::mt19937 random(3);
  for (int i = 0; i < 80; ++i)
    random_pairs.push_back({static_cast<int>(random() % 30), static_cast<int>(random() % 30)});
  const std::vector<std::pair<int, Pairs>> cases{
      {1, {}}, {3, {}}, {2, {{1, 0}}}, {5, chain_with_loops}, {12, star}, {30, random_pairs}};
  for (const auto& [unknowns, pairs] : cases) {
    SCOPED_TRACE(unknowns);
    Both matrix(unknowns, pairs, 7);
    ASSERT_TRUE(matrix.sparse.Factorise());
    ExpectSolves<1>(matrix.sparse, matrix.dense);
    ExpectSolves<6>(matrix.sparse, matrix.dense);
  }
}

TEST(BlockCholesky, NothingToSolve) {
  BlockCholesky empty(0, {});
  EXPECT_TRUE(empty.Factorise());
  EXPECT_TRUE(empty.Solve(BlockCholesky::Vector<1>()).empty());
}

TEST(BlockCholesky, SaysWhatIsNotPositiveDefinite) {
  const Pairs pair{{0, 1}};
  BlockCholesky zero(2, pair);
  EXPECT_FALSE(zero.Factorise());
  Both indefinite(2, pair, 1);
  indefinite.Add(0, 1, 1000 * Block::Identity());
  EXPECT_FALSE(indefinite.sparse.Factorise());
}

TEST(BlockCholesky, IsFilledAgainAfterItWasFactorised) {
  const Pairs pairs{{0, 1}, {1, 2}};
  Both first(3, pairs, 1);
  ASSERT_TRUE(first.sparse.Factorise());
  first.sparse.SetZero();
  for (int i = 0; i < 3; ++i) first.sparse.Add(i, i, 4 * Block::Identity());
  ASSERT_TRUE(first.sparse.Factorise());
  ExpectSolves<1>(first.sparse, 4 * Eigen::MatrixXd::Identity(18, 18));
}

}  // namespace
}  // namespace sslcd
