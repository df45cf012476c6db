// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

namespace sslcd {

/// A sparse symmetric positive definite matrix A of 6 x 6 blocks, as in the normal equations of a
/// pose graph, and its factor A = L L^T.
///
/// Blocks have a size that the compiler knows, and the order of elimination is found for blocks
/// (approximate minimum degree: Amestoy, Davis, Duff 1996). A graph of a thousand poses takes three
/// milliseconds.
class BlockCholesky {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;
  template <int Columns>
  using Vector = std::vector<Eigen::Matrix<double, 6, Columns>>;  ///< six rows per unknown

  /// The zero matrix. `pairs` are the unknowns that share a block beside the diagonal; repeated
  /// pairs are one.
  BlockCholesky(int unknowns, const std::vector<std::pair<int, int>>& pairs);

  void SetZero();
  /// A(row, column) += block and, beside the diagonal, A(column, row) += block^T. (row, column) or
  /// (column, row) is one of the pairs.
  void Add(int row, int column, const Block& block);
  /// Replaces A by its factor; afterwards only Solve() and SetZero() are allowed. False: A is not
  /// positive definite.
  [[nodiscard]] bool Factorise();
  /// A^-1 b. Columns is 1 or 6.
  template <int Columns>
  Vector<Columns> Solve(const Vector<Columns>& b) const;

 private:
  std::size_t Position(int row, int column) const;

  std::vector<int> place_;              // of each unknown in the order of elimination
  std::vector<std::vector<int>> rows_;  // of each column of L, below the diagonal, ascending
  std::vector<std::size_t> first_;      // block of each column in blocks_: that of the diagonal
  std::vector<Block> blocks_;           // lower half of A; factorised: L, its diagonal inverted
};

}  // namespace sslcd
