// SPDX-License-Identifier: BSD-3-Clause
#include "formats/g2o.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>

#include "formats/information.h"
#include "formats/number_text.h"
#include "formats/pose_text.h"
#include "formats/text_rows.h"

namespace sslcd {
namespace {

using Information = Eigen::Matrix<double, 6, 6>;

void ExpectNumbers(const TextRows& row, std::size_t ids, std::size_t numbers) {
  if (row.size() == 1 + ids + numbers) return;
  row.Fail(std::string(row.Text(0)) + ": expected " + std::to_string(ids + numbers) +
           " fields after it, found " + std::to_string(row.size() - 1));
}

double FiniteNumber(const TextRows& row, std::size_t column) {
  const double value = row.Number(column);
  if (!std::isfinite(value))
    row.Fail("column " + std::to_string(column + 1) + " is not finite: correct or remove the row");
  return value;
}

// x y z qx qy qz qw
Pose ReadSe3(const TextRows& row, std::size_t column) {
  double v[7];
  for (int i = 0; i < 7; ++i) v[i] = FiniteNumber(row, column + i);
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(std::abs(q.norm() - 1) <= kRotationTolerance)) {
    row.Fail("the quaternion's length is " + std::to_string(q.norm()) +
             ", expected 1: correct the row, or check the order (x y z qx qy qz qw)");
  }
  return Pose::FromQuaternionTranslation(q, Vec3(v[0], v[1], v[2]));
}

// x y yaw
Pose ReadSe2(const TextRows& row, std::size_t column) {
  const Vec3 t(FiniteNumber(row, column), FiniteNumber(row, column + 1), 0);
  return Pose(lie::SO3<double>::RotZ(FiniteNumber(row, column + 2)), t);
}

// Reads the upper triangle of a symmetric matrix.
Eigen::MatrixXd ReadUpperTriangle(const TextRows& row, std::size_t column, int size) {
  Eigen::MatrixXd matrix(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = i; j < size; ++j) matrix(i, j) = matrix(j, i) = FiniteNumber(row, column++);
  return matrix;
}

// Puts a matrix over the given components of [tx ty tz rx ry rz] into the full one. The other
// components keep a fixed value.
Information Lift(const Eigen::MatrixXd& matrix, const std::vector<int>& components) {
  Information information = kLiftedInformation * Information::Identity();
  for (std::size_t i = 0; i < components.size(); ++i)
    for (std::size_t j = 0; j < components.size(); ++j)
      information(components[i], components[j]) = matrix(i, j);
  return information;
}

bool IsPositiveDefinite(const Information& information) {
  return Eigen::LLT<Information>(information).info() == Eigen::Success;
}

// Rounding and components without a measurement do not explain such rows: the projection would hide
// a broken writer.
void CheckDiagonal(const TextRows& row, const Eigen::MatrixXd& matrix) {
  const double largest = matrix.diagonal().maxCoeff();
  if (largest <= 0) {
    row.Fail(
        "the information matrix has no positive diagonal entry: an edge without information "
        "measures nothing, remove the row or give it its information");
  }
  if (matrix.diagonal().minCoeff() < -kInformationFloor * largest) {
    row.Fail(
        "the information matrix has a negative diagonal entry, which no measurement has: check the "
        "order of its columns (upper triangle, row by row)");
  }
}

struct G2oReader {
  G2oFile file;
  std::map<int, FileLocation> vertex_rows;  // by id
  std::vector<FileLocation> edge_rows;      // one per edge
  std::map<int, FileLocation> fixed;        // FIX rows, which may come before their vertices
  bool any_se3 = false, any_se2 = false;

  void AddVertex(const TextRows& row, bool planar) {
    ExpectNumbers(row, 1, planar ? 3 : 7);
    const int id = row.Integer(1);
    const auto [earlier, is_new] = vertex_rows.emplace(id, row.where());
    if (!is_new) {
      row.Fail("vertex " + std::to_string(id) + " is a duplicate of line " +
               std::to_string(earlier->second.line) + ": remove one of the rows");
    }
    file.graph.vertices.push_back({id, planar ? ReadSe2(row, 2) : ReadSe3(row, 2)});
  }

  void AddEdge(const TextRows& row, bool planar) {
    ExpectNumbers(row, 2, planar ? 3 + 6 : 7 + 21);
    PoseGraph::Edge edge;
    edge.from = row.Integer(1);
    edge.to = row.Integer(2);
    if (edge.from == edge.to)
      row.Fail("the edge leads from vertex " + std::to_string(edge.from) + " to itself");
    edge.T_from_to = planar ? ReadSe2(row, 3) : ReadSe3(row, 3);
    edge.information =
        planar ? ReadInformation(row, 6, {0, 1, 5}) : ReadInformation(row, 10, {0, 1, 2, 3, 4, 5});
    file.graph.edges.push_back(edge);
    edge_rows.push_back(row.where());
  }

  // Projects before lifting, so that the floor is relative to the row's own numbers.
  Information ReadInformation(const TextRows& row, std::size_t column,
                              const std::vector<int>& components) {
    const Eigen::MatrixXd given =
        ReadUpperTriangle(row, column, static_cast<int>(components.size()));
    const Information information = Lift(given, components);
    if (IsPositiveDefinite(information)) return information;
    CheckDiagonal(row, given);
    const std::optional<ProjectedInformation> projected = ProjectInformation(given);
    if (!projected || !IsPositiveDefinite(Lift(projected->information, components)))
      row.Fail("the information matrix is out of the range of numbers: check its unit");
    if (file.information_projected++ == 0) file.first_projected = row.where();
    file.least_eigenvalue = std::min(file.least_eigenvalue, projected->least_eigenvalue);
    return Lift(projected->information, components);
  }

  void Read(const std::string& path) {
    TextRows row(path);
    while (row.Next()) {
      const std::string_view tag = row.Text(0);
      const bool planar = tag == "VERTEX_SE2" || tag == "EDGE_SE2";
      const bool vertex = tag == "VERTEX_SE2" || tag == "VERTEX_SE3:QUAT";
      const bool edge = tag == "EDGE_SE2" || tag == "EDGE_SE3:QUAT";
      if (vertex) AddVertex(row, planar);
      if (edge) AddEdge(row, planar);
      if (tag == "FIX")
        for (std::size_t i = 1; i < row.size(); ++i) fixed.emplace(row.Integer(i), row.where());
      if (vertex || edge) (planar ? any_se2 : any_se3) = true;
      if (!vertex && !edge && tag != "FIX") ++file.rows_ignored;
    }
    file.planar = any_se2 && !any_se3;
  }

  void CheckEnds() const {
    for (std::size_t e = 0; e < edge_rows.size(); ++e) {
      for (const int id : {file.graph.edges[e].from, file.graph.edges[e].to}) {
        if (vertex_rows.count(id) > 0) continue;
        throw Error(
            ErrorKind::kBadInput, edge_rows[e],
            "vertex " + std::to_string(id) + " has no VERTEX row: add one, or remove the edge");
      }
    }
  }

  // An odometry edge joins an id and the next existing id, in either direction.
  void MarkLoops() {
    std::set<int> ids;
    for (const PoseGraph::Vertex& vertex : file.graph.vertices) ids.insert(vertex.id);
    for (const PoseGraph::Edge& edge : file.graph.edges) ids.insert({edge.from, edge.to});
    for (PoseGraph::Edge& edge : file.graph.edges)
      edge.loop =
          *std::next(ids.find(std::min(edge.from, edge.to))) != std::max(edge.from, edge.to);
  }

  void Fix() {
    for (PoseGraph::Vertex& vertex : file.graph.vertices) vertex.fixed = fixed.erase(vertex.id) > 0;
    if (fixed.empty()) return;
    const auto& [id, where] = *fixed.begin();
    throw Error(ErrorKind::kBadInput, where,
                "FIX names vertex " + std::to_string(id) + ", which does not exist");
  }
};

// Computes the vertices of a file without vertex rows, from the lowest id of each component
// outwards. Uses loops only if odometry reaches no new vertex.
std::vector<PoseGraph::Vertex> VerticesFromEdges(const PoseGraph& graph) {
  struct Step {
    int id = 0;
    Pose pose;  // T_world_id, or T_from_id in `steps`
    bool loop = false;
  };
  std::map<int, std::vector<Step>> steps;
  for (const PoseGraph::Edge& edge : graph.edges) {
    steps[edge.from].push_back({edge.to, edge.T_from_to, edge.loop});
    steps[edge.to].push_back({edge.from, edge.T_from_to.inverse(), edge.loop});
  }
  std::map<int, Pose> placed;
  for (const auto& [root, unused] : steps) {
    std::deque<Step> odometry = {{root, Pose(), false}}, loops;
    while (!odometry.empty() || !loops.empty()) {
      std::deque<Step>& queue = odometry.empty() ? loops : odometry;
      const Step at = queue.front();
      queue.pop_front();
      if (!placed.emplace(at.id, at.pose).second) continue;
      for (const Step& step : steps[at.id])
        if (!placed.count(step.id))
          (step.loop ? loops : odometry).push_back({step.id, at.pose * step.pose, step.loop});
    }
  }
  std::vector<PoseGraph::Vertex> vertices;
  for (const auto& [id, pose] : placed) vertices.push_back({id, pose});
  return vertices;
}

}  // namespace

G2oFile ReadG2o(const std::string& path) {
  G2oReader reader;
  reader.Read(path);
  PoseGraph& graph = reader.file.graph;
  reader.MarkLoops();
  if (graph.vertices.empty()) {
    graph.vertices = VerticesFromEdges(graph);
  } else {
    reader.CheckEnds();
  }
  reader.Fix();
  return reader.file;
}

std::string G2oText(const PoseGraph& graph) {
  std::string text;
  for (const auto& vertex : graph.vertices) {
    text += "VERTEX_SE3:QUAT " + std::to_string(vertex.id) + " " + PoseText(vertex.T_world_vertex) +
            "\n";
    if (vertex.fixed) text += "FIX " + std::to_string(vertex.id) + "\n";
  }
  for (const auto& edge : graph.edges) {
    text += "EDGE_SE3:QUAT " + std::to_string(edge.from) + " " + std::to_string(edge.to) + " " +
            PoseText(edge.T_from_to);
    for (int row = 0; row < 6; ++row)
      for (int column = row; column < 6; ++column)
        text += " " + ShortestNumber(edge.information(row, column));
    text += "\n";
  }
  return text;
}

}  // namespace sslcd
