// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>

#include "commands.h"
#include "examples.h"
#include "formats/atomic_file.h"
#include "formats/g2o.h"
#include "formats/metrics_json.h"
#include "overwriting.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"
#include "sslcd/pose_graph/pose_graph.h"
#include "threads.h"

namespace sslcd::apps {
namespace {

const std::map<std::string, Vec3> kUpAxes = {{"x", {1, 0, 0}},   {"y", {0, 1, 0}},
                                             {"z", {0, 0, 1}},   {"-x", {-1, 0, 0}},
                                             {"-y", {0, -1, 0}}, {"-z", {0, 0, -1}}};

struct GraphArguments {
  std::string in, out, dof = "auto", up = "z", start = "auto";
  bool robust = false, strict = false, json = false;
  int threads = 1;

  PoseGraphOptions Options(bool planar) const {
    PoseGraphOptions options;
    if (dof == "3" || (dof == "auto" && planar)) options.freedom = PoseFreedom::kPlanar;
    if (dof == "4") options.freedom = PoseFreedom::kUpright;
    if (start == "given") options.start = PoseGraphStart::kGiven;
    if (start == "chordal") options.start = PoseGraphStart::kChordal;
    options.gravity = GravityFrame::FromUp(kUpAxes.at(up));
    return options;
  }
};

// Solves `graph` and removes the refused loops from it.
RobustPoseGraphSummary Solve(PoseGraph& graph, const PoseGraphOptions& options, bool robust) {
  RobustPoseGraphSummary summary;
  if (!robust) {
    summary.graph = SolvePoseGraph(graph, options);
    return summary;
  }
  RobustPoseGraphOptions robust_options;
  robust_options.graph = options;
  summary = SolveRobust(graph, robust_options);
  std::vector<PoseGraph::Edge> kept;
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    if (summary.edge_weight[e] > 0) kept.push_back(graph.edges[e]);
  graph.edges = kept;
  return summary;
}

// Refuses or reports information matrices that the reader has projected.
void CheckInformation(const G2oFile& file, const std::string& path, bool strict) {
  if (file.information_projected == 0) return;
  if (strict) {
    throw Error(ErrorKind::kBadInput, file.first_projected,
                "the information matrix is not positive definite: correct it (upper triangle, row "
                "by row), or leave out --strict to have it projected to the nearest one that is");
  }
  Log(LogLevel::kWarning,
      path + ": " + std::to_string(file.information_projected) + " of " +
          std::to_string(file.graph.edges.size()) +
          " information matrices are not positive definite and were projected to the nearest ones "
          "that are (first: line " +
          std::to_string(file.first_projected.line) + "; smallest eigenvalue " +
          Number("%.2g", file.least_eigenvalue) + " of the largest); --strict refuses them");
}

Metrics Report(const G2oFile& file, const RobustPoseGraphSummary& summary, bool robust,
               double seconds) {
  const PoseGraph& given = file.graph;
  const auto loops = std::count_if(given.edges.begin(), given.edges.end(),
                                   [](const auto& edge) { return edge.loop; });
  Metrics metrics = {{"vertices", given.vertices.size()},
                     {"edges", given.edges.size()},
                     {"loops", loops},
                     {"information_projected", file.information_projected},
                     {"components", summary.graph.components},
                     {"chi2_before", summary.graph.initial_chi2},
                     {"chi2_after", summary.graph.final_chi2},
                     {"iterations", summary.graph.iterations},
                     {"converged", summary.graph.converged},
                     {"chordal_start", summary.graph.chordal},
                     {"seconds", seconds}};
  if (robust) {
    metrics.insert(metrics.end(), {{"loops_kept", summary.loops_kept},
                                   {"loops_refused", summary.loops_refused},
                                   {"rounds", summary.rounds}});
  }
  return metrics;
}

int Graph(const GraphArguments& a, const Console& console) {
  RefuseOverwriting({a.in}, {a.out});
  const G2oFile file = ReadG2o(a.in);
  if (file.graph.edges.empty()) {
    throw Error(ErrorKind::kBadInput,
                a.in + ": no EDGE_SE3:QUAT or EDGE_SE2 rows: there is nothing to optimise");
  }
  if (file.rows_ignored > 0)
    Log(LogLevel::kWarning,
        a.in + ": " + std::to_string(file.rows_ignored) + " rows of other kinds were left out");
  CheckInformation(file, a.in, a.strict);
  PoseGraph graph = file.graph;
  const auto start = std::chrono::steady_clock::now();
  const RobustPoseGraphSummary summary = Solve(graph, a.Options(file.planar), a.robust);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!summary.graph.usable)
    throw Error(ErrorKind::kNoSolution, a.in + ": " + summary.graph.message);
  if (!summary.graph.converged) Log(LogLevel::kWarning, "stopped early: " + summary.graph.message);
  if (summary.graph.components > 1) {
    Log(LogLevel::kWarning,
        std::to_string(summary.graph.components) +
            " parts that no edge joins: each keeps its first vertex, unless another one is fixed");
  }
  WriteFileAtomically(a.out, G2oText(graph));

  const Metrics metrics = Report(file, summary, a.robust, seconds);
  if (a.json) {
    std::fputs(MetricsJson(metrics).c_str(), stdout);
    return 0;
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, value] : metrics) rows.push_back({name, Number("%.7g", *value)});
  console.Say(AlignedTable(rows));
  console.Say("wrote " + a.out);
  return 0;
}

}  // namespace

Command AddGraphCommand(CLI::App& app, Console& console) {
  CLI::App* command = app.add_subcommand("graph", "optimise a pose graph (.g2o)");
  const auto arguments = std::make_shared<GraphArguments>();
  command->add_option("IN", arguments->in, "file with SE3:QUAT or SE2 rows")->required();
  command->add_option("--out", arguments->out, "file to write, SE3:QUAT")->required();
  command->add_flag("--robust", arguments->robust,
                    "doubt the loops: edges between consecutive ids (i -> i + 1) are odometry and "
                    "trusted, all others "
                    "are loops; refused ones are left out of the file written, and chi2 counts the "
                    "kept ones only");
  command
      ->add_option("--dof", arguments->dof,
                   "of a pose: 3 (horizontal and yaw), 4 (translation and yaw) or 6")
      ->check(CLI::IsMember({"auto", "3", "4", "6"}))
      ->default_str("auto: 3 for SE2 files, otherwise 6");
  std::vector<std::string> axes;
  for (const auto& [name, axis] : kUpAxes) axes.push_back(name);
  command->add_option("--up", arguments->up, "the world's vertical, for 3 and 4 DoF")
      ->check(CLI::IsMember(axes))
      ->default_str("z");
  command
      ->add_option("--start", arguments->start,
                   "poses to start from: as given, chordal, or the better ones")
      ->check(CLI::IsMember({"auto", "given", "chordal"}));
  command->add_flag("--strict", arguments->strict,
                    "refuse information matrices that are not positive definite; otherwise they "
                    "are projected to the nearest ones that are, and counted");
  AddThreads(*command, arguments->threads);
  command->add_flag("--json", arguments->json, "print JSON and nothing else");
  command->add_flag("-q,--quiet", console.quiet, "print errors only");
  command->footer(Examples({"graph runs/monday/graph.g2o --out optimised.g2o",
                            "graph sphere.g2o --out kept.g2o --robust --json"}));
  return [arguments, &console] {
    console.InstallLog();
    return Graph(*arguments, console);
  };
}

}  // namespace sslcd::apps
