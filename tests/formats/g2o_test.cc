// SPDX-License-Identifier: BSD-3-Clause
#include "formats/g2o.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "formats/information.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

const std::string kUnit3d = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1";

G2oFile Read(const std::string& text) {
  const TempFolder folder;
  return ReadG2o(folder.Write("a.g2o", text));
}

void ExpectRefused(const std::string& text, const std::vector<std::string>& parts) {
  const TempFolder folder;
  const std::string path = folder.Write("a.g2o", text);
  ExpectError([&] { ReadG2o(path); }, parts);
}

TEST(G2o, ReadsSe3) {
  const G2oFile file = Read(
      "# a comment\n"
      "VERTEX_SE3:QUAT 3 1 2 3 0 0 0 1\n"
      "VERTEX_SE3:QUAT 4 2 2 3 0 0 1 0\n"
      "FIX 3\n"
      "VERTEX_TRACKXYZ 9 1 1 1\n"
      "EDGE_SE3:QUAT 3 4 1 0 0 0 0 1 0 11 12 13 14 15 16 22 23 24 25 26 330 34 35 36 440 45 46 550 "
      "56 660\n");
  EXPECT_FALSE(file.planar);
  EXPECT_EQ(file.rows_ignored, 1);
  ASSERT_EQ(file.graph.vertices.size(), 2u);
  EXPECT_EQ(file.graph.vertices[0].id, 3);
  EXPECT_TRUE(file.graph.vertices[0].fixed);
  EXPECT_FALSE(file.graph.vertices[1].fixed);
  EXPECT_EQ(file.graph.vertices[0].T_world_vertex.translation(), Vec3(1, 2, 3));
  ASSERT_EQ(file.graph.edges.size(), 1u);
  const PoseGraph::Edge& edge = file.graph.edges[0];
  EXPECT_FALSE(edge.loop);
  EXPECT_EQ(edge.T_from_to.so3().unit_quaternion().z(), 1);
  EXPECT_EQ(edge.information(0, 5), 16);
  EXPECT_EQ(edge.information(5, 0), 16);
  EXPECT_EQ(edge.information(2, 3), 34);
  EXPECT_EQ(edge.information(5, 5), 660);
}

TEST(G2o, LiftsSe2) {
  const G2oFile file = Read(
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 2 0.5\n"
      "EDGE_SE2 0 1 1 2 0.5 10 1 2 20 3 30\n");
  EXPECT_TRUE(file.planar);
  const Pose& T = file.graph.edges[0].T_from_to;
  EXPECT_EQ(T.translation(), Vec3(1, 2, 0));
  EXPECT_NEAR(T.Log()[5], 0.5, 1e-15);
  const auto& information = file.graph.edges[0].information;
  EXPECT_EQ(information(0, 0), 10);
  EXPECT_EQ(information(0, 1), 1);
  EXPECT_EQ(information(5, 0), 2);
  EXPECT_EQ(information(1, 5), 3);
  EXPECT_EQ(information(5, 5), 30);
  for (const int i : {2, 3, 4}) EXPECT_EQ(information(i, i), kLiftedInformation);
}

TEST(G2o, MarksLoops) {
  const G2oFile file = Read(
      "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 1 -1 0 0 1 0 0 1 0 1\n"
      "EDGE_SE2 2 5 1 0 0 1 0 0 1 0 1\nEDGE_SE2 5 0 -3 0 0 1 0 0 1 0 1\n");
  std::vector<bool> loops;
  for (const auto& edge : file.graph.edges) loops.push_back(edge.loop);
  EXPECT_EQ(loops, (std::vector<bool>{false, false, false, true}))
      << "2 -> 5: there is nothing in between";
}

TEST(G2o, VerticesFromEdgesFollowTheOdometry) {
  const G2oFile file = Read(
      "EDGE_SE2 2 0 7 7 0 1 0 0 1 0 1\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 1 0 0 1 0 0 1 "
      "0 1\n");
  ASSERT_EQ(file.graph.vertices.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(file.graph.vertices[i].id, i);
    EXPECT_NEAR((file.graph.vertices[i].T_world_vertex.translation() - Vec3(i, 0, 0)).norm(), 0,
                1e-12);
  }
}

TEST(G2o, ReadsWhatItWrites) {
  PoseGraph graph;
  graph.vertices = {{0, Pose(), true}, {7, Pose::Trans(1, 2, 3) * Pose::RotX(0.3)}};
  PoseGraph::Edge edge;
  edge.from = 0;
  edge.to = 7;
  edge.T_from_to = Pose::Trans(1, 2, 3.1);
  edge.information(0, 4) = edge.information(4, 0) = 0.25;
  graph.edges = {edge};
  const PoseGraph back = Read(G2oText(graph)).graph;
  ASSERT_EQ(back.vertices.size(), 2u);
  EXPECT_TRUE(back.vertices[0].fixed);
  EXPECT_NEAR(
      (back.vertices[1].T_world_vertex.inverse() * graph.vertices[1].T_world_vertex).Log().norm(),
      0, 1e-8);
  EXPECT_EQ(back.edges[0].information, edge.information);
}

TEST(G2o, EmptyFilesAreEmptyGraphs) {
  for (const char* text : {"", "\n", "# nothing\n"}) {
    const G2oFile file = Read(text);
    EXPECT_TRUE(file.graph.vertices.empty());
    EXPECT_TRUE(file.graph.edges.empty());
  }
}

TEST(G2o, RefusesBadRows) {
  const std::string two = "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 1 0 0 0 0 0 1\n";
  const std::string step = " 1 0 0 0 0 0 1";
  ExpectError([] { ReadG2o("/nonexistent.g2o"); }, {"/nonexistent.g2o"});
  ExpectRefused("VERTEX_SE3:QUAT 0 0 0 0 0 0 0\n", {"a.g2o:1", "expected 8 fields", "found 7"});
  ExpectRefused("VERTEX_SE2 0 0 0\n", {"a.g2o:1", "expected 4 fields"});
  ExpectRefused(two + "EDGE_SE3:QUAT 0 1" + step + "\n",
                {"a.g2o:3", "expected 30 fields", "found 9"});
  ExpectRefused("VERTEX_SE2 0 0 x 0\n", {"a.g2o:1", "x"});
  ExpectRefused("VERTEX_SE2 zero 0 0 0\n", {"a.g2o:1", "zero"});
  ExpectRefused("VERTEX_SE2 0 0 nan 0\n", {"a.g2o:1", "not finite"});
  ExpectRefused("VERTEX_SE2 0 0 0 inf\n", {"a.g2o:1", "not finite"});
  ExpectRefused("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n", {"a.g2o:1", "length is 0"});
  ExpectRefused("VERTEX_SE3:QUAT 0 0 0 0 1 1 0 1\n", {"a.g2o:1", "x y z qx qy qz qw"});
  ExpectRefused(two + two, {"a.g2o:3", "vertex 0 is a duplicate of line 1"});
  ExpectRefused(two + "EDGE_SE3:QUAT 0 2" + step + kUnit3d + "\n",
                {"a.g2o:3", "vertex 2 has no VERTEX row"});
  ExpectRefused(two + "EDGE_SE3:QUAT 1 1" + step + kUnit3d + "\n", {"a.g2o:3", "to itself"});
  ExpectRefused(two + "FIX 5\n", {"a.g2o:3", "FIX names vertex 5"});
  ExpectRefused("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 nan\n", {"a.g2o:1", "not finite"});
  for (const char* bad : {"-1 0 0 1 0 1", "1 0 0 1 0 -1e-6"})
    ExpectRefused(std::string("EDGE_SE2 0 1 1 0 0 ") + bad + "\n",
                  {"a.g2o:1", "negative diagonal entry", "upper triangle"});
  for (const char* bad : {"0 0 0 0 0 0", "0 1 0 0 0 0", "-1 0 0 -1 0 -1"})
    ExpectRefused(std::string("EDGE_SE2 0 1 1 0 0 ") + bad + "\n",
                  {"a.g2o:1", "no positive diagonal entry", "remove the row"});
  ExpectRefused("EDGE_SE2 0 1 1 0 0 1e-320 0 0 1e-320 0 0\n", {"a.g2o:1", "out of the range"});
}

using Information = Eigen::Matrix<double, 6, 6>;

double SmallestEigenvalue(const Information& information) {
  return Eigen::SelfAdjointEigenSolver<Information>(information).eigenvalues()[0];
}

TEST(G2o, ProjectsInformationThatIsNotPositiveDefinite) {
  const G2oFile file = Read(
      "EDGE_SE2 0 1 1 0 0 4 0 0 4 0 9\n"
      "EDGE_SE2 1 2 1 0 0 4 5 0 4 0 9\n"         // eigenvalues -1, 9, 9
      "EDGE_SE2 2 3 1 0 0 0 0 0 0 0 9\n"         // measures yaw only
      "EDGE_SE2 3 4 1 0 0 4 0 0 4 0 -1e-12\n");  // rounding
  EXPECT_EQ(file.information_projected, 3);
  EXPECT_EQ(file.first_projected.line, 2);
  EXPECT_NEAR(file.least_eigenvalue, -1. / 9, 1e-15);
  const auto information = [&](int edge) {
    return Information(file.graph.edges[edge].information);
  };
  EXPECT_EQ(information(0).diagonal(), (Vec6() << 4, 4, 1e8, 1e8, 1e8, 9).finished());
  EXPECT_NEAR(information(1)(0, 0), 4.5, 1e-7);
  EXPECT_NEAR(information(1)(0, 1), 4.5, 1e-7);
  EXPECT_NEAR(information(1)(5, 5), 9, 1e-12);
  EXPECT_NEAR(information(2)(0, 0), 9 * kInformationFloor, 1e-20)
      << "not relative to the lifted 1e8";
  EXPECT_NEAR(information(3)(5, 5), 4 * kInformationFloor, 1e-20);
  for (int edge = 1; edge < 4; ++edge) {
    EXPECT_GT(SmallestEigenvalue(information(edge)), 0.99 * 4 * kInformationFloor);
    for (const int i : {2, 3, 4}) EXPECT_EQ(information(edge)(i, i), kLiftedInformation);
  }
}

TEST(G2o, ReadsEdgesWithoutSomeComponents) {
  const std::string bearing_only = "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 40 0 0 40 0 40";
  const std::string flat = "10 0 0 0 0 2 10 0 0 0 1 0 0 0 0 0 0 0 0 0 40";
  const std::string one = "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1e-300";
  for (const std::string& information : {bearing_only, flat, one}) {
    const G2oFile file = Read("EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 " + information + "\n");
    EXPECT_EQ(file.information_projected, 1);
    EXPECT_EQ(file.least_eigenvalue, 0);
    EXPECT_GT(SmallestEigenvalue(file.graph.edges[0].information), 0);
  }
}

TEST(G2o, KeepsPositiveDefiniteInformationBitByBit) {
  // An eigenvalue far below the floor, but a Cholesky factor exists.
  const G2oFile file = Read("EDGE_SE2 0 1 1 0 0 1e12 0.1 0 1e-6 0 0.3\n");
  EXPECT_EQ(file.information_projected, 0);
  EXPECT_EQ(file.first_projected.line, 0);
  EXPECT_EQ(file.graph.edges[0].information(0, 0), 1e12);
  EXPECT_EQ(file.graph.edges[0].information(1, 1), 1e-6);
  EXPECT_EQ(file.graph.edges[0].information(5, 5), 0.3);
}

TEST(G2o, ProjectedInformationIsWrittenAndReadAsItIs) {
  const PoseGraph graph = Read("EDGE_SE2 0 1 1 0 0 4 5 1 4 0.3 9\n").graph;
  const G2oFile back = Read(G2oText(graph));
  EXPECT_EQ(back.information_projected, 0);
  EXPECT_EQ(back.graph.edges[0].information, graph.edges[0].information);
}

}  // namespace
}  // namespace sslcd
