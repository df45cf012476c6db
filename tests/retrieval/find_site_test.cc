// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/find_site.h"

#include <gmock/gmock.h>

namespace sslcd {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(HighestScores, AreTheHighestInTheOrderOfTheirPlaces) {
  EXPECT_THAT(HighestScores({1, 5, 2, 9}, 2), ElementsAre(1, 3));
  EXPECT_THAT(HighestScores({1, 2, 3}, 1), ElementsAre(2));
  EXPECT_THAT(HighestScores({3, 2}, 5), ElementsAre(0, 1));
  EXPECT_THAT(HighestScores({}, 3), IsEmpty());
}

TEST(HighestScores, EqualOnesDoNotTakeThePlaceOfHigherOnes) {
  EXPECT_THAT(HighestScores({0, 0, 0, 0, 1}, 2), ElementsAre(0, 4));
}

}  // namespace
}  // namespace sslcd
