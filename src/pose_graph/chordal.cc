// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/chordal.h"

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

namespace sslcd {
namespace {

using Ends = std::vector<std::pair<int, int>>;
using Rows3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

// Minimises sum_e w_e |x_to - A_e x_from - b_e|^2 over vectors or matrices x_v of `Size` rows and
// three columns; anchored ones are given. Collects the normal equations edge by edge.
template <int Size>
class LinearGraph {
 public:
  using Block = Eigen::Matrix<double, Size, Size>;
  using Value = Eigen::Matrix<double, Size, 3>;

  explicit LinearGraph(const std::vector<bool>& anchored) : column_(anchored.size(), -1) {
    for (std::size_t v = 0; v < anchored.size(); ++v)
      if (!anchored[v]) column_[v] = unknowns_++;
    b_ = Rows3::Zero(Size * unknowns_, 3);
  }

  /// x holds the values of anchored vertices.
  void Add(int from, int to, double weight, const Block& A, const Value& b,
           const std::vector<Value>& x) {
    Couple(from, from, weight * A.transpose() * A, x);
    Couple(from, to, -weight * A.transpose(), x);
    Couple(to, from, -weight * A, x);
    Couple(to, to, weight * Block::Identity(), x);
    AddRight(from, -weight * A.transpose() * b);
    AddRight(to, weight * b);
  }

  bool Solve(std::vector<Value>& x) const {
    if (unknowns_ == 0) return true;
    Eigen::SparseMatrix<double> H(Size * unknowns_, Size * unknowns_);
    H.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(H);
    if (solver.info() != Eigen::Success) return false;
    const Rows3 solution = solver.solve(b_);
    for (std::size_t v = 0; v < x.size(); ++v)
      if (column_[v] >= 0) x[v] = solution.middleRows<Size>(Size * column_[v]);
    return solution.allFinite();
  }

 private:
  void Couple(int row, int column, const Block& block, const std::vector<Value>& x) {
    if (column_[row] < 0) return;
    if (column_[column] < 0) {
      b_.middleRows<Size>(Size * column_[row]) -= block * x[column];
      return;
    }
    if (column_[row] < column_[column]) return;  // the lower triangle suffices
    for (int i = 0; i < Size; ++i)
      for (int j = 0; j < Size; ++j)
        entries_.emplace_back(Size * column_[row] + i, Size * column_[column] + j, block(i, j));
  }
  void AddRight(int row, const Value& value) {
    if (column_[row] >= 0) b_.middleRows<Size>(Size * column_[row]) += value;
  }

  std::vector<int> column_;
  int unknowns_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
  Rows3 b_;
};

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

}  // namespace

std::optional<std::vector<Pose>> ChordalStart(const PoseGraph& graph, const Ends& ends,
                                              const std::vector<double>& weights,
                                              const std::vector<bool>& anchored) {
  const auto weight = [&](std::size_t e, int block) {
    return weights[e] * graph.edges[e].information.diagonal().segment<3>(3 * block).mean();
  };
  // R_j = R_i R_ij, transposed to have the unknowns on the right: R_j^T = R_ij^T R_i^T.
  std::vector<Eigen::Matrix3d> rotations;
  for (const auto& vertex : graph.vertices)
    rotations.push_back(vertex.T_world_vertex.so3().matrix().transpose());
  LinearGraph<3> rotation_graph(anchored);
  for (std::size_t e = 0; e < ends.size(); ++e) {
    if (weights[e] == 0) continue;
    rotation_graph.Add(ends[e].first, ends[e].second, weight(e, 1),
                       graph.edges[e].T_from_to.so3().matrix().transpose(), Eigen::Matrix3d::Zero(),
                       rotations);
  }
  if (!rotation_graph.Solve(rotations)) return std::nullopt;
  for (Eigen::Matrix3d& R : rotations) R = NearestRotation(R);

  // t_j = t_i + R_i t_ij: the three components have the same matrix, so a point is a row.
  using Row3 = Eigen::Matrix<double, 1, 3>;
  std::vector<Row3> translations;
  for (const auto& vertex : graph.vertices)
    translations.push_back(vertex.T_world_vertex.translation().transpose());
  LinearGraph<1> translation_graph(anchored);
  for (std::size_t e = 0; e < ends.size(); ++e) {
    if (weights[e] == 0) continue;
    const Row3 step = graph.edges[e].T_from_to.translation().transpose() * rotations[ends[e].first];
    translation_graph.Add(ends[e].first, ends[e].second, weight(e, 0),
                          Eigen::Matrix<double, 1, 1>(1.), step, translations);
  }
  if (!translation_graph.Solve(translations)) return std::nullopt;

  std::vector<Pose> poses;
  for (std::size_t v = 0; v < rotations.size(); ++v) {
    poses.push_back(graph.vertices[v].T_world_vertex);
    if (anchored[v]) continue;
    poses[v] =
        Pose(lie::SO3<double>::FromMatrix(rotations[v].transpose()), translations[v].transpose());
  }
  return poses;
}

}  // namespace sslcd
