// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/block_cholesky.h"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cassert>

namespace sslcd {
namespace {

// Place of each unknown in an order of elimination that fills L with few blocks.
std::vector<int> Places(int unknowns, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < unknowns; ++i) entries.emplace_back(i, i, 1.);
  for (const auto& [a, b] : pairs) entries.emplace_back(std::max(a, b), std::min(a, b), 1.);
  Eigen::SparseMatrix<double> pattern(unknowns, unknowns);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Lower>(), order);
  std::vector<int> places(unknowns);
  for (int place = 0; place < unknowns; ++place) places[order.indices()[place]] = place;
  return places;
}

}  // namespace

BlockCholesky::BlockCholesky(int unknowns, const std::vector<std::pair<int, int>>& pairs)
    : place_(Places(unknowns, pairs)), rows_(unknowns) {
  for (const auto& [a, b] : pairs)
    if (a != b) rows_[std::min(place_[a], place_[b])].push_back(std::max(place_[a], place_[b]));
  std::size_t blocks = 0;
  for (std::vector<int>& rows : rows_) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    first_.push_back(blocks);
    blocks += 1 + rows.size();
    // Eliminating the column joins the others of its rows: the next of them takes them over.
    if (rows.empty()) continue;
    std::vector<int>& parent = rows_[rows.front()];
    parent.insert(parent.end(), rows.begin() + 1, rows.end());
  }
  blocks_.assign(blocks, Block::Zero());
}

void BlockCholesky::SetZero() { std::fill(blocks_.begin(), blocks_.end(), Block::Zero()); }

std::size_t BlockCholesky::Position(int row, int column) const {
  if (row == column) return first_[column];
  const std::vector<int>& rows = rows_[column];
  const auto found = std::lower_bound(rows.begin(), rows.end(), row);
  assert(found != rows.end() && *found == row);
  return first_[column] + 1 + (found - rows.begin());
}

void BlockCholesky::Add(int row, int column, const Block& block) {
  const int i = place_[row], j = place_[column];
  if (i >= j)
    blocks_[Position(i, j)] += block;
  else
    blocks_[Position(j, i)] += block.transpose();
}

bool BlockCholesky::Factorise() {
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    Block* const column = &blocks_[first_[j]];
    const std::vector<int>& rows = rows_[j];
    const Eigen::LLT<Block> diagonal(column[0]);
    if (diagonal.info() != Eigen::Success || !column[0].allFinite()) return false;
    column[0] = diagonal.matrixL().solve(Block::Identity());
    const Block inverse_transposed = column[0].transpose();
    for (std::size_t i = 1; i <= rows.size(); ++i)
      column[i] = Block(column[i].lazyProduct(inverse_transposed));
    for (std::size_t k = 0; k < rows.size(); ++k) {  // L_jk L_jk^T leaves the columns of its rows
      const Block right = column[k + 1].transpose();
      Block* const target = &blocks_[first_[rows[k]]];
      const int* const target_rows = rows_[rows[k]].data();
      target[0] -= column[k + 1].lazyProduct(right);
      for (std::size_t i = k + 1, t = 0; i < rows.size(); ++i) {
        while (target_rows[t] != rows[i]) ++t;
        target[1 + t] -= column[i + 1].lazyProduct(right);
      }
    }
  }
  return true;
}

template <int Columns>
BlockCholesky::Vector<Columns> BlockCholesky::Solve(const Vector<Columns>& b) const {
  Vector<Columns> x(b.size()), result(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) x[place_[i]] = b[i];
  for (std::size_t j = 0; j < x.size(); ++j) {
    const Block* const column = &blocks_[first_[j]];
    x[j] = (column[0].template triangularView<Eigen::Lower>() * x[j]).eval();
    for (std::size_t i = 0; i < rows_[j].size(); ++i)
      x[rows_[j][i]] -= column[i + 1].lazyProduct(x[j]);
  }
  for (std::size_t j = x.size(); j-- > 0;) {
    const Block* const column = &blocks_[first_[j]];
    for (std::size_t i = 0; i < rows_[j].size(); ++i)
      x[j] -= column[i + 1].transpose().lazyProduct(x[rows_[j][i]]);
    x[j] = (column[0].transpose().template triangularView<Eigen::Upper>() * x[j]).eval();
  }
  for (std::size_t i = 0; i < b.size(); ++i) result[i] = x[place_[i]];
  return result;
}

template BlockCholesky::Vector<1> BlockCholesky::Solve<1>(const Vector<1>&) const;
template BlockCholesky::Vector<6> BlockCholesky::Solve<6>(const Vector<6>&) const;

}  // namespace sslcd
