// SPDX-License-Identifier: BSD-3-Clause
#include "loop/semantics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sslcd {
namespace {

AppearanceView View(std::vector<float> vector, int count = 1) {
  AppearanceView view;
  view.vector = std::move(vector);
  view.count = count;
  return view;
}

LayoutObject Car() {
  LayoutObject car;
  car.label = 3;
  car.position = Vec3(1, 2, 3);
  car.dims = Vec3(4, 2, 1.5);
  car.appearance[Cue::kColour] = {View({1.f, 0.f})};
  car.appearance[Cue::kEmbedding] = {View({0.f, 0.f, 1.f})};
  return car;
}

TEST(PaperSemantics, AreEquations12To16AsPrinted) {
  const LayoutObject a = Car();
  LayoutObject b = Car();
  b.position = Vec3(1, 2, 3.5);
  b.dims = Vec3(4.3, 2.4, 1.5);
  b.appearance[Cue::kColour] = {View({0.6f, 0.8f})};
  b.appearance[Cue::kEmbedding] = {View({0.f, 1.f, 0.f})};
  const PaperCues cues = CompareAsPrinted(a, b);
  EXPECT_NEAR(*cues.scale, std::exp(-0.5), 1e-12);
  EXPECT_NEAR(*cues.position, std::exp(-0.5), 1e-12);
  EXPECT_NEAR(*cues.appearance[Cue::kColour], std::exp(-0.6), 1e-6);
  EXPECT_NEAR(*cues.appearance[Cue::kEmbedding], 1, 1e-12)
      << "nothing in common counts as best: as printed";
  EXPECT_NEAR(*PaperSimilarity(cues, 0.3), 0.3 * 2 * std::exp(-0.5) + 0.7 * (std::exp(-0.6) + 1),
              1e-6);
  EXPECT_NEAR(SemanticSimilarity(a, b, 0.3), *PaperSimilarity(cues, 0.3), 1e-15);
}

TEST(PaperSemantics, DifferentLabelsAreZero) {
  LayoutObject b = Car();
  b.label = 4;
  EXPECT_EQ(SemanticSimilarity(Car(), b, 0.5), 0);
}

TEST(PaperSemantics, MissingCuesDropOutAndTheRestIsScaledUp) {
  LayoutObject plain = Car();
  plain.appearance[Cue::kColour].clear();
  plain.appearance[Cue::kEmbedding] = {View({1.f, 0.f})};  // of another length
  PaperCues cues = CompareAsPrinted(Car(), plain);
  EXPECT_FALSE(cues.appearance[Cue::kColour]);
  EXPECT_FALSE(cues.appearance[Cue::kEmbedding]);
  EXPECT_NEAR(*PaperSimilarity(cues, 0.3), 2, 1e-12);
  plain.dims = Vec3(0, 0, 0);
  EXPECT_FALSE(CompareAsPrinted(Car(), plain).scale);
  plain.position = Vec3(0, 0, std::numeric_limits<double>::quiet_NaN());
  cues = CompareAsPrinted(Car(), plain);
  EXPECT_FALSE(PaperSimilarity(cues, 0.5));
  EXPECT_EQ(SemanticSimilarity(Car(), plain, 0.5), 0);
  EXPECT_FALSE(PaperSimilarity({0.5, 0.5, {}}, 0.)) << "mu 0 listens to colour and embedding only";
}

TEST(PaperSemantics, EachCueCounts) {
  for (const CueRow& row : kCueRows) {
    LayoutObject a, b;
    a.appearance[row.cue] = {View({1.f, 0.f})};
    b.appearance[row.cue] = {View({0.6f, 0.8f})};
    EXPECT_NEAR(*PaperSimilarity(CompareAsPrinted(a, b), 0.), 2 * std::exp(-0.6), 1e-6) << row.name;
  }
}

TEST(PaperSemantics, SeveralViewsCountBySightings) {
  LayoutObject a = Car(), b = Car();
  a.appearance[Cue::kEmbedding] = {View({1.f, 0.f}, 3), View({0.f, 1.f}, 1)};
  b.appearance[Cue::kEmbedding] = {View({1.f, 0.f}, 1)};
  EXPECT_NEAR(*CompareAsPrinted(a, b).appearance[Cue::kEmbedding], std::exp(-0.75), 1e-12);
  b.appearance[Cue::kEmbedding] = {View({std::numeric_limits<float>::quiet_NaN(), 0.f}, 1)};
  EXPECT_FALSE(CompareAsPrinted(a, b).appearance[Cue::kEmbedding]);
}

TEST(PaperSemantics, OppositeVectorsCountByTheirModulus) {
  LayoutObject a = Car(), b = Car();
  b.appearance[Cue::kColour] = {View({-1.f, 0.f})};
  EXPECT_NEAR(*CompareAsPrinted(a, b).appearance[Cue::kColour], std::exp(-1.), 1e-12)
      << "as printed: |h h'|";
}

}  // namespace
}  // namespace sslcd
