// SPDX-License-Identifier: BSD-3-Clause
// Graphs like the public torus3D, with and without indefinite information, through a file.
#include <gtest/gtest.h>

#include "formats/g2o.h"
#include "sslcd/pose_graph/pose_graph.h"
#include "temp_folder.h"
#include "torus_world.h"

namespace sslcd {
namespace {

G2oFile ThroughFile(const PoseGraph& graph) {
  const TempFolder folder;
  return ReadG2o(folder.Write("torus.g2o", G2oText(graph)));
}

// chi2 of the minimum that is reached from the ground truth.
PoseGraphSummary SolveFromTruth(PoseGraph graph, const std::vector<Pose>& truth) {
  for (std::size_t v = 0; v < truth.size(); ++v) graph.vertices[v].T_world_vertex = truth[v];
  PoseGraphOptions options;
  options.start = PoseGraphStart::kGiven;
  return SolvePoseGraph(graph, options);
}

TEST(Torus, SolvesWithDefiniteInformation) {
  const TorusWorld world = MakeTorus({});
  G2oFile file = ThroughFile(world.graph);
  EXPECT_EQ(file.information_projected, 0);
  const PoseGraphSummary summary = SolvePoseGraph(file.graph, {});
  EXPECT_TRUE(summary.converged);
  // As many as the measurements exceed the unknowns.
  const double freedom = 6. * (file.graph.edges.size() - world.truth.size() + 1);
  EXPECT_NEAR(summary.final_chi2 / freedom, 1, 4 * std::sqrt(2 / freedom));
}

TEST(Torus, SolvesWithIndefiniteInformation) {
  TorusOptions options;
  options.indefinite_share = 0.3;
  const TorusWorld world = MakeTorus(options);
  ASSERT_NEAR(world.indefinite, 0.3 * world.graph.edges.size(), 0.04 * world.graph.edges.size());
  PoseGraph refused = world.graph;
  ASSERT_FALSE(SolvePoseGraph(refused, {}).usable) << "the solver asks for definite information";

  G2oFile file = ThroughFile(world.graph);
  EXPECT_EQ(file.information_projected, world.indefinite);
  const PoseGraphSummary summary = SolvePoseGraph(file.graph, {});
  EXPECT_TRUE(summary.converged);
  const PoseGraphSummary from_truth = SolveFromTruth(file.graph, world.truth);
  EXPECT_TRUE(from_truth.converged);
  EXPECT_LT(from_truth.final_chi2, from_truth.initial_chi2);
  EXPECT_NEAR(summary.final_chi2, from_truth.final_chi2, 1e-4 * from_truth.final_chi2);

  PoseGraph definite = MakeTorus({}).graph;
  ASSERT_TRUE(SolvePoseGraph(definite, {}).converged);
  EXPECT_LT(AteRmse(file.graph, world.truth), 1.5 * AteRmse(definite, world.truth));
}

// Edges that measure rotation only hang on the floor; the positions come from the other edges.
TEST(Torus, SolvesWithEdgesThatMeasureRotationOnly) {
  TorusWorld world = MakeTorus({});
  int changed = 0;
  for (std::size_t e = world.truth.size(); e < world.graph.edges.size(); e += 2, ++changed)
    world.graph.edges[e].information.topLeftCorner<3, 3>().setZero();
  G2oFile file = ThroughFile(world.graph);
  EXPECT_EQ(file.information_projected, changed);
  EXPECT_EQ(file.least_eigenvalue, 0);
  const PoseGraphSummary summary = SolvePoseGraph(file.graph, {});
  EXPECT_TRUE(summary.converged);
  const double chi2 = SolveFromTruth(file.graph, world.truth).final_chi2;
  EXPECT_NEAR(summary.final_chi2, chi2, 1e-4 * chi2);
}

}  // namespace
}  // namespace sslcd
