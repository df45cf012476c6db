// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "formats/g2o.h"
#include "results.h"
#include "sslcd/core/error.h"
#include "sslcd/pose_graph/pose_graph.h"

namespace sslcd::python {
namespace {

using namespace py::literals;
using Ids = py::array_t<int, py::array::c_style | py::array::forcecast>;
using Flags = py::array_t<bool, py::array::c_style | py::array::forcecast>;

// Of a sslcd.results.PoseGraph, which has checked its arrays.
PoseGraph GraphFrom(const py::handle& given) {
  PoseGraph graph;
  const auto ids = given.attr("ids").cast<Ids>();
  const auto fixed = given.attr("fixed").cast<Flags>();
  const std::vector<Pose> poses = PosesFrom(given.attr("poses").cast<Array>(), "poses");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    graph.vertices.push_back({ids.at(row), poses[i], fixed.at(row)});
  }
  const auto edges = given.attr("edges").cast<Ids>();
  const auto loops = given.attr("loops").cast<Flags>();
  const auto information = given.attr("information").cast<Array>();
  const std::vector<Pose> measurements =
      PosesFrom(given.attr("measurements").cast<Array>(), "measurements");
  using RowMajor = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    PoseGraph::Edge edge;
    edge.from = edges.at(row, 0);
    edge.to = edges.at(row, 1);
    edge.T_from_to = measurements[i];
    edge.information = Eigen::Map<const RowMajor>(information.data(row, 0, 0));
    edge.loop = loops.at(row);
    graph.edges.push_back(edge);
  }
  return graph;
}

PoseGraphOptions OptionsOf(int dof, const Array& up, const std::string& start) {
  PoseGraphOptions options;
  if (dof != 3 && dof != 4 && dof != 6)
    throw Error(ErrorKind::kUsage, "dof is " + std::to_string(dof) + ", must be one of 3, 4, 6");
  options.freedom = dof == 3   ? PoseFreedom::kPlanar
                    : dof == 4 ? PoseFreedom::kUpright
                               : PoseFreedom::kFull;
  options.gravity = GravityFrame::FromUp(VectorFrom(up));
  if (start == "given")
    options.start = PoseGraphStart::kGiven;
  else if (start == "chordal")
    options.start = PoseGraphStart::kChordal;
  else if (start != "auto")
    throw Error(ErrorKind::kUsage, "start is '" + start + "', must be one of auto, given, chordal");
  return options;
}

RobustPoseGraphSummary Solve(PoseGraph& graph, const PoseGraphOptions& options, bool robust) {
  const py::gil_scoped_release release;
  RobustPoseGraphSummary summary;
  if (robust) {
    RobustPoseGraphOptions robust_options;
    robust_options.graph = options;
    summary = SolveRobust(graph, robust_options);
  } else {
    summary.graph = SolvePoseGraph(graph, options);
    summary.edge_weight.assign(graph.edges.size(), 1);
  }
  if (!summary.graph.usable) throw Error(ErrorKind::kNoSolution, summary.graph.message);
  return summary;
}

py::object SolveGraph(const py::object& given, int dof, const Array& up, const std::string& start,
                      bool robust) {
  PoseGraph graph = GraphFrom(given);
  const RobustPoseGraphSummary summary = Solve(graph, OptionsOf(dof, up, start), robust);
  const PoseGraphSummary& s = summary.graph;
  return Make(
      "GraphSolution", "graph"_a = ToPython(graph),
      "kept"_a = Column<bool>(summary.edge_weight, [](double weight) { return weight > 0; }),
      "converged"_a = s.converged, "iterations"_a = s.iterations, "components"_a = s.components,
      "chi2_before"_a = s.initial_chi2, "chi2_after"_a = s.final_chi2,
      "chordal_start"_a = s.chordal, "message"_a = s.message);
}

py::tuple Read(const std::string& path) {
  const G2oFile file = [&path] {
    const py::gil_scoped_release release;
    return ReadG2o(path);
  }();
  return py::make_tuple(ToPython(file.graph), file.planar, file.rows_ignored,
                        file.information_projected);
}

}  // namespace

void BindGraph(py::module_& module) {
  module.def("read_g2o", &Read, py::arg("path"));
  module.def(
      "g2o_text", [](const py::object& graph) { return G2oText(GraphFrom(graph)); },
      py::arg("graph"));
  module.def("solve_graph", &SolveGraph, py::arg("graph"), py::arg("dof"), py::arg("up"),
             py::arg("start"), py::arg("robust"));
}

}  // namespace sslcd::python
