// SPDX-License-Identifier: BSD-3-Clause
#include "loop/semantic_evidence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "loop/appearance_likelihood.h"
#include "loop/heading_density.h"
#include "row_cases.h"

namespace sslcd {
namespace {

std::vector<LayoutObject> WithLabels(const std::vector<int>& labels) {
  std::vector<LayoutObject> objects;
  for (const int label : labels)
    objects.push_back(ObjectAt({10. * static_cast<double>(objects.size()), 0, 0}, label));
  return objects;
}

TEST(SemanticEvidence, RareLabelsCountMore) {
  const LayoutIndex index(WithLabels({1, 1, 1, 2}), 50, 2);
  const std::vector<LayoutObject> local = WithLabels({1, 2});
  LayoutLikelihoodOptions options;
  options.wrong_label = 0.1;
  const SemanticEvidence evidence(local, index, options);
  // Shares with one more object of each label: 4 and 2 of 6.
  EXPECT_NEAR(evidence.Gain(0, 0, 0), std::log(0.9 * 6 / 4), 1e-12);
  EXPECT_NEAR(evidence.Gain(1, 3, 0), std::log(0.9 * 6 / 2), 1e-12);
  EXPECT_NEAR(evidence.Gain(0, 3, 0), std::log(0.1), 1e-12);
}

TEST(SemanticEvidence, InALargeMapWrongLabelsAreEquallyLikely) {
  for (const int labels : {2, 3}) {
    std::vector<LayoutObject> map = CarParks(20, 1);
    for (LayoutObject& object : map) object.label %= labels;
    const LayoutIndex index(map, 50, 2);
    ASSERT_NE(index.tiles(), nullptr);
    const std::vector<LayoutObject> local = WithLabels({0, 1});
    LayoutLikelihoodOptions options;
    options.wrong_label = 0.1;
    const SemanticEvidence evidence(local, index, options);
    const auto of_label = [&](int label) {
      for (std::size_t i = 0; i < map.size(); ++i)
        if (map[i].label == label) return static_cast<int>(i);
      return -1;
    };
    // .9 for the right one, .1 for all others
    for (const int i : {0, 1})
      EXPECT_NEAR(
          evidence.Gain(i, of_label(i), 0) - evidence.Gain(i, of_label((i + 1) % labels), 0),
          std::log(0.9 / (0.1 / (labels - 1))), 1e-9);
  }
}

TEST(SemanticEvidence, OneLabelIsNoEvidence) {
  const LayoutIndex index(WithLabels({3, 3}), 50, 2);
  const std::vector<LayoutObject> local = WithLabels({3});
  EXPECT_EQ(SemanticEvidence(local, index, {}).Gain(0, 1, 0), 0);
}

TEST(SemanticEvidence, HeadingsAreComparedUnderThePose) {
  std::vector<LayoutObject> map = WithLabels({3, 3}), local = WithLabels({3, 3});
  map[0].yaw = 2;
  local[0].yaw = local[1].yaw = 0.5;
  local[1].symmetry = Symmetry::kPi;
  const LayoutIndex index(map, 50, 2);
  const SemanticEvidence evidence(local, index, {});
  const double ratio = HeadingDensity(0, Symmetry::kNone) / HeadingDensity(0.4, Symmetry::kNone);
  EXPECT_NEAR(evidence.Gain(0, 0, 1.5) - evidence.Gain(0, 0, 1.9), std::log(ratio), 1e-12);
  EXPECT_GT(evidence.Gain(0, 0, 1.5), evidence.Gain(0, 0, 1.5 + M_PI) + 1);
  EXPECT_EQ(evidence.Gain(0, 1, 1.5), 0) << "the map's heading is unknown";
  EXPECT_EQ(evidence.Gain(1, 0, 1.5), 0) << "of another symmetry";
}

TEST(SemanticEvidence, AppearanceAddsToTheLabel) {
  std::vector<LayoutObject> map = WithLabels({3, 3}), local = WithLabels({3});
  map[0].appearance[Cue::kColour] = local[0].appearance[Cue::kColour] = {{0, 5, {1, 0}}};
  map[1].appearance[Cue::kColour] = {{0, 5, {0, 1}}};
  const LayoutIndex index(map, 50, 2);
  const SemanticEvidence evidence(local, index, {});
  for (const int global : {0, 1}) {
    const double gain = AppearanceGain(local[0], map[global], {});
    EXPECT_NE(gain, 0);
    EXPECT_EQ(evidence.Gain(0, global, 0), gain);
    EXPECT_EQ(evidence.Gain(0, global, 0), gain) << "from the cache";
  }
}

TEST(LayoutLikelihood, RareLabelsOutweighADistance) {
  std::vector<LayoutObject> local = WithLabels({1, 2, 3, 4});
  std::vector<LayoutObject> map = local;
  for (LayoutObject& object : map) object.position.x() += 1;
  for (int i = 0; i < 400; ++i)
    map.push_back(ObjectAt({50. + 8 * (i % 20), 50. + 8 * (i / 20), 0}));
  const LayoutIndex index(map, 50, 2);
  EXPECT_EQ(LayoutLikelihood(local, index, {}).Evaluate({}).matches.size(), 4u);
}

}  // namespace
}  // namespace sslcd
