// SPDX-License-Identifier: BSD-3-Clause
#include "association/associate.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

PlanarGaussian At(double x, double y, double sigma) {
  PlanarGaussian prediction;
  prediction.position = Vec2(x, y);
  prediction.covariance = sigma * sigma * Eigen::Matrix2d::Identity();
  return prediction;
}

struct Scene {
  std::vector<Detection> detections;
  std::vector<AssociationQuery> queries;
  std::vector<AssociationCandidate> candidates;

  Scene() { detections.reserve(16); }
  void See(double x, double y, const std::string& label = "Car", std::optional<Box2d> box = {}) {
    detections.emplace_back();
    detections.back().label = label;
    detections.back().box = box;
    AssociationQuery query;
    query.detection = &detections.back();
    query.place = At(x, y, 0.3);
    queries.push_back(query);
  }
  void Know(double x, double y, const std::string& label = "Car", std::optional<Box2d> box = {}) {
    AssociationCandidate candidate;
    candidate.label = label;
    candidate.predictions = {At(x, y, 0.1)};
    candidate.projected_box = box;
    candidates.push_back(candidate);
  }
};

TEST(Associate, EachCueTellsNeighboursApart) {
  for (const CueRow& row : kCueRows) {
    Scene scene;
    scene.Know(0, 10);
    scene.Know(0.6, 10);
    scene.See(0.3, 10);  // in the middle
    const std::vector<float> red{1, 0}, blue{0, 1};
    std::vector<PerCue<Gallery>> looks(2);
    looks[0][row.cue].Add(red, 0);
    looks[1][row.cue].Add(blue, 0);
    for (std::size_t k = 0; k < 2; ++k) scene.candidates[k].appearance = &looks[k];
    const Eigen::MatrixXd unknown = AssociationMatrix(scene.queries, scene.candidates, {});
    EXPECT_NEAR(unknown(0, 0), unknown(0, 1), 1e-12) << row.name << ": a detection without it";
    scene.detections[0].appearance[row.cue] = blue;
    EXPECT_EQ(Associate(scene.queries, scene.candidates, {}), std::vector<int>{1}) << row.name;
    scene.detections[0].appearance[row.cue] = red;
    EXPECT_EQ(Associate(scene.queries, scene.candidates, {}), std::vector<int>{0}) << row.name;
    for (AssociationCandidate& candidate : scene.candidates) candidate.appearance = nullptr;
    EXPECT_EQ(AssociationMatrix(scene.queries, scene.candidates, {}), unknown)
        << row.name << ": landmarks without it";
  }
}

TEST(Associate, MatchesARowOfCarsOneToOne) {
  Scene scene;
  for (int i = 0; i < 5; ++i) scene.Know(2.5 * i, 10);
  for (int i = 4; i >= 1; --i) scene.See(2.5 * i + 0.3, 10.2);
  EXPECT_EQ(Associate(scene.queries, scene.candidates, {}), (std::vector<int>{4, 3, 2, 1}));
}

TEST(Associate, LabelsNeverMix) {  // Eq. 2
  Scene scene;
  scene.Know(0, 10, "Van");
  scene.See(0, 10, "Car");
  for (const auto method :
       {AssociationOptions::Method::kRobust, AssociationOptions::Method::kPaper}) {
    AssociationOptions options;
    options.method = method;
    EXPECT_EQ(Associate(scene.queries, scene.candidates, options), std::vector<int>{-1});
  }
}

TEST(Associate, TheGateClosesInMetresSigmasAndHeight) {
  Scene scene;
  scene.Know(0, 10);
  scene.See(0, 13);  // 3 m: far more than 3.5 sigma of 0.3 m
  EXPECT_EQ(Associate(scene.queries, scene.candidates, {}), std::vector<int>{-1});
  scene.queries[0].place = At(0, 13, 2.);  // a detector with this noise allows it
  EXPECT_EQ(Associate(scene.queries, scene.candidates, {}), std::vector<int>{0});
  AssociationOptions narrow;
  narrow.gate_m = 2.;  // the gate in metres excludes it
  EXPECT_EQ(Associate(scene.queries, scene.candidates, narrow), std::vector<int>{-1});
  scene.queries[0].height = 5;
  EXPECT_EQ(Associate(scene.queries, scene.candidates, {}), std::vector<int>{-1});
}

TEST(Associate, TheImageDecidesWhereDistanceCannot) {
  Scene scene;
  const Box2d left{100, 100, 150, 140}, right{160, 100, 210, 140};
  scene.Know(-0.4, 30, "Car", left);
  scene.Know(0.4, 30, "Car", right);
  scene.See(0, 30, "Car", right);
  EXPECT_EQ(Associate(scene.queries, scene.candidates, {}), std::vector<int>{1});
}

TEST(Associate, PaperModeKnowsNoDistance) {
  Scene scene;
  const Box2d box{100, 100, 150, 140};
  scene.Know(0, 10, "Car", box);
  scene.See(0, 60, "Car", box);
  AssociationOptions paper;
  paper.method = AssociationOptions::Method::kPaper;
  EXPECT_EQ(Associate(scene.queries, scene.candidates, paper), std::vector<int>{0});
  EXPECT_EQ(Associate(scene.queries, scene.candidates, {}), std::vector<int>{-1});
}

TEST(Associate, NothingToMatch) {
  Scene scene;
  EXPECT_TRUE(Associate(scene.queries, scene.candidates, {}).empty());
  scene.See(0, 10);
  EXPECT_EQ(Associate(scene.queries, scene.candidates, {}), std::vector<int>{-1});
}

}  // namespace
}  // namespace sslcd
