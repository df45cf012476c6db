// SPDX-License-Identifier: BSD-3-Clause
#include "loop/appearance_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "layout_cases.h"

namespace sslcd {
namespace {

// A view whose vector has the given cosine to that of View(.., 1).
AppearanceView View(double viewpoint_rad, double cosine) {
  const auto x = static_cast<float>(cosine), y = static_cast<float>(std::sqrt(1 - cosine * cosine));
  return {viewpoint_rad, 1, {x, y}};
}

LayoutObject Car(const AppearanceView& view) {
  LayoutObject car;
  car.appearance[Cue::kEmbedding] = {view};
  return car;
}

double Gain(double angle, double cosine, Symmetry symmetry = Symmetry::kNone) {
  LayoutObject a = Car(View(0.3, 1)), b = Car(View(0.3 + angle, cosine));
  a.symmetry = b.symmetry = symmetry;
  return AppearanceGain(a, b, {});
}

TEST(AppearanceGain, KnowsTheViewingAngle) {
  EXPECT_GT(Gain(0, 0.75), 2);
  EXPECT_LT(Gain(0, 0.3), -2);
  EXPECT_GT(Gain(M_PI, 0.45), 0.5) << "as alike as opposite sides of one car are";
  EXPECT_LT(Gain(0, 0.45), 0) << "but too different for one side";
  EXPECT_NEAR(Gain(M_PI, 0.45, Symmetry::kPi), Gain(0, 0.45, Symmetry::kPi), 1e-9);
  EXPECT_NEAR(Gain(2, 0.45, Symmetry::kFull), Gain(0, 0.45, Symmetry::kFull), 1e-9);
}

TEST(AppearanceGain, FromOppositeSidesIsJudgedByWhatIsExpectedThere) {
  const LayoutObject front = Car(View(0, 1)), back = Car(View(M_PI, 0.7)), side = Car(View(0, 0.7));
  AppearanceOptions usual, alike;
  usual.cosine[Cue::kEmbedding].opposite_side = 0.45;
  alike.cosine[Cue::kEmbedding].opposite_side = 0.7;
  usual.limit = alike.limit = 100;
  EXPECT_GT(AppearanceGain(front, back, alike), AppearanceGain(front, back, usual) + 0.1);
  EXPECT_EQ(AppearanceGain(front, side, alike), AppearanceGain(front, side, usual));
}

TEST(AppearanceGain, FromOneSideIsJudgedByWhatIsExpectedThere) {
  const LayoutObject car = Car(View(0, 1)), again = Car(View(0, 0.7)), back = Car(View(M_PI, 0.7));
  AppearanceOptions usual, poor;
  usual.cosine[Cue::kEmbedding].same_side = 0.9;
  poor.cosine[Cue::kEmbedding].same_side = 0.7;
  usual.limit = poor.limit = 100;
  EXPECT_GT(AppearanceGain(car, again, poor), AppearanceGain(car, again, usual) + 0.1);
  EXPECT_EQ(AppearanceGain(car, back, poor), AppearanceGain(car, back, usual));
}

TEST(AppearanceGain, SaysLessWhereOtherObjectsLookAlike) {
  const LayoutObject car = Car(View(0, 1)), again = Car(View(0, 0.9));
  AppearanceOptions usual, alike;
  usual.cosine[Cue::kEmbedding].other_object = 0.3;
  alike.cosine[Cue::kEmbedding].other_object = 0.8;
  usual.limit = alike.limit = 100;
  EXPECT_GT(AppearanceGain(car, again, usual), AppearanceGain(car, again, alike) + 0.1);
}

TEST(AppearanceGain, IsEvidenceAndNeverAGate) {
  const AppearanceOptions options;
  for (const double cosine : {-1., 0., 0.5, 1.})
    EXPECT_LE(std::abs(Gain(0, cosine)), options.limit);
}

TEST(AppearanceGain, EachCueAloneIsEvidenceUpToItsLimit) {
  const AppearanceOptions options;
  for (const CueRow& row : kCueRows) {
    LayoutObject a, same, other;
    a.appearance[row.cue] = {View(0, 1)};
    same.appearance[row.cue] = {View(0, 1)};
    other.appearance[row.cue] = {View(0, 0)};
    const double limit = row.limit_share.value_or(1) * options.limit;
    EXPECT_GT(AppearanceGain(a, same, options), 0) << row.name;
    EXPECT_LE(AppearanceGain(a, same, options), limit) << row.name;
    EXPECT_LT(AppearanceGain(a, other, options), 0) << row.name;
    EXPECT_GE(AppearanceGain(a, other, options), -limit) << row.name;
  }
}

TEST(AppearanceGain, CuesAddUpToTheLimit) {
  const AppearanceOptions options;
  LayoutObject a = Car(View(0, 1)), b = Car(View(0, 0.5));
  const double embedding = AppearanceGain(a, b, options);
  a.appearance[Cue::kColour] = b.appearance[Cue::kColour] = {View(0, 1)};
  EXPECT_NEAR(AppearanceGain(a, b, options), embedding + options.limit / 3, 1e-12);
  b.appearance[Cue::kEmbedding] = {View(0, 1)};
  EXPECT_EQ(AppearanceGain(a, b, options), options.limit);
}

TEST(AppearanceGain, IsZeroWhereNothingCanBeCompared) {
  LayoutObject a = Car(View(0, 1)), b;
  EXPECT_EQ(AppearanceGain(a, b, {}), 0);
  b.appearance[Cue::kEmbedding] = {{0, 1, {1, 0, 0}}};
  EXPECT_EQ(AppearanceGain(a, b, {}), 0) << "vectors of different lengths";
  b.appearance[Cue::kEmbedding] = {{0, 1, {NAN, 0}}};
  EXPECT_EQ(AppearanceGain(a, b, {}), 0);
  b.appearance[Cue::kEmbedding] = {{0, 0, {1, 0}}};
  EXPECT_EQ(AppearanceGain(a, b, {}), 0) << "no sightings";
}

std::vector<LayoutObject> Row() {
  std::vector<LayoutObject> row;
  for (int i = 0; i < 8; ++i) {
    row.push_back(ObjectAt({6. * i, 0.1 * i, 0}));
    row.back().yaw = 0.5;
  }
  return row;
}

TEST(Semantics, HeadingsTellAHalfTurn) {
  const std::vector<LayoutObject> row = Row();
  const YawShift turned{2., {10, 0, 0}};
  std::vector<LayoutObject> local = SeenFrom(row, turned, {21, 0}, 40, 0, 1), blind = local;
  for (LayoutObject& object : local) object.yaw = WrapAngle(object.yaw - turned.yaw);
  for (LayoutObject& object : blind) object.yaw = NAN;
  EXPECT_EQ(MatchLayouts(blind, row).decision, LoopDecision::kAmbiguous);
  const LayoutAnswer answer = MatchLayouts(local, row);
  ASSERT_EQ(answer.decision, LoopDecision::kAccepted) << answer.reason;
  EXPECT_NEAR(WrapAngle(answer.hypotheses[0].pose.yaw - turned.yaw), 0, 0.01);
}

TEST(Semantics, HeadingsOfFrontAndBackAlikeTellNothing) {
  std::vector<LayoutObject> row = Row();
  for (LayoutObject& object : row) object.symmetry = Symmetry::kPi;
  EXPECT_EQ(MatchLayouts(row, row).decision, LoopDecision::kAmbiguous);
  for (LayoutObject& object : row) object.symmetry = Symmetry::kFull;
  EXPECT_EQ(MatchLayouts(row, row).decision, LoopDecision::kAmbiguous);
}

// A grid of objects that differ in this cue alone.
std::vector<LayoutObject> Grid(Cue cue) {
  std::vector<LayoutObject> grid;
  for (int i = 0; i < 30; ++i) {
    grid.push_back(ObjectAt({2.5 * (i % 6), 6. * (i / 6), 0}));
    std::vector<float> vector(30, 0.1f);
    vector[i] = 1;
    float norm = 0;
    for (const float v : vector) norm += v * v;
    for (float& v : vector) v /= std::sqrt(norm);
    grid.back().appearance[cue] = {{0, 1, vector}};
  }
  return grid;
}

TEST(Semantics, EachCueSettlesAGrid) {
  for (const CueRow& row : kCueRows) {
    const std::vector<LayoutObject> grid = Grid(row.cue);
    const LayoutAnswer answer = MatchLayouts(grid, grid);
    ASSERT_EQ(answer.decision, LoopDecision::kAccepted) << row.name << ": " << answer.reason;
    EXPECT_LT(ShiftBetween(answer.hypotheses[0].pose, {}, Vec3(10, 20, 0)), 0.01) << row.name;
  }
}

}  // namespace
}  // namespace sslcd
