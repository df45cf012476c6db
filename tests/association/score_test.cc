// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/association/score.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

TEST(AssociationScore, IsEquation3) {
  const double lambda = 0.3;
  const SimilarityCues cues{0.5, 0.7, 0.9};
  EXPECT_NEAR(*AssociationScore(cues, lambda), 0.3 * 0.5 + 0.3 * 0.7 * 0.7 + 0.7 * 0.7 * 0.9,
              1e-15);
}

TEST(AssociationScore, WeightsSumToOneForAnyLambda) {
  for (const double lambda : {0., 0.1, 0.5, 1.})
    EXPECT_NEAR(*AssociationScore({1., 1., 1.}, lambda), 1., 1e-15);
}

TEST(AssociationScore, MissingCuesAreRenormalised) {
  EXPECT_NEAR(*AssociationScore({0.6, {}, {}}, 0.4), 0.6, 1e-15);
  EXPECT_NEAR(*AssociationScore({0.6, {}, 0.2}, 0.5), (0.5 * 0.6 + 0.25 * 0.2) / 0.75, 1e-15);
  EXPECT_FALSE(AssociationScore({}, 0.5));
  EXPECT_FALSE(AssociationScore({0.6, 0.3, {}}, 0.)) << "lambda 0 listens to the embedding only";
}

}  // namespace
}  // namespace sslcd
