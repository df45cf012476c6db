// SPDX-License-Identifier: BSD-3-Clause
#include "association/score.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

SimilarityCues Cues(std::optional<double> iou, std::optional<double> colour,
                    std::optional<double> embedding) {
  SimilarityCues cues;
  cues.iou = iou;
  cues.appearance[Cue::kColour] = colour;
  cues.appearance[Cue::kEmbedding] = embedding;
  return cues;
}

TEST(AssociationScore, IsEquation3) {
  const double lambda = 0.3;
  const SimilarityCues cues = Cues(0.5, 0.7, 0.9);
  EXPECT_NEAR(*AssociationScore(cues, lambda), 0.3 * 0.5 + 0.3 * 0.7 * 0.7 + 0.7 * 0.7 * 0.9,
              1e-15);
}

TEST(AssociationScore, WeightsSumToOneForAnyLambda) {
  for (const double lambda : {0., 0.1, 0.5, 1.})
    EXPECT_NEAR(*AssociationScore(Cues(1., 1., 1.), lambda), 1., 1e-15);
}

TEST(AssociationScore, MissingCuesAreRenormalised) {
  EXPECT_NEAR(*AssociationScore(Cues(0.6, {}, {}), 0.4), 0.6, 1e-15);
  EXPECT_NEAR(*AssociationScore(Cues(0.6, {}, 0.2), 0.5), (0.5 * 0.6 + 0.25 * 0.2) / 0.75, 1e-15);
  EXPECT_FALSE(AssociationScore({}, 0.5));
  EXPECT_FALSE(AssociationScore(Cues(0.6, 0.3, {}), 0.))
      << "lambda 0 listens to the embedding only";
}

TEST(AssociationScore, EachCueCountsByItsWeight) {
  const double lambda = 0.3;
  for (const CueRow& row : kCueRows) {
    SimilarityCues cues = Cues(0.5, {}, {});
    cues.appearance[row.cue] = 0.9;
    const double weight = row.weight(lambda);
    EXPECT_NEAR(*AssociationScore(cues, lambda), (lambda * 0.5 + weight * 0.9) / (lambda + weight),
                1e-15)
        << row.name;
  }
}

}  // namespace
}  // namespace sslcd
