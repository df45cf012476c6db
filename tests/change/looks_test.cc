// SPDX-License-Identifier: BSD-3-Clause
#include "change/looks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd {
namespace {

// Seen `sightings` times from one direction, with an embedding at an angle to the first axis.
SessionLooks Looks(double angle, double viewpoint = 0, int sightings = 10) {
  SessionLooks looks;
  for (int i = 0; i < sightings; ++i)
    looks.views[Cue::kEmbedding].Add(
        {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}, viewpoint);
  looks.ahead = looks.sightings = sightings;
  return looks;
}

double LogSame(const SessionLooks& a, const SessionLooks& b, Symmetry symmetry = Symmetry::kNone) {
  return LogSameObject(Compare(a, b, symmetry), LookStatistics::Prior());
}

TEST(Looks, AlikeIsTheSameAndUnlikeIsAnother) {
  EXPECT_GT(LogSame(Looks(0), Looks(0.3)), 2);
  EXPECT_LT(LogSame(Looks(0), Looks(1.5)), -2);
}

TEST(Looks, NothingToCompareSaysNothing) {
  EXPECT_EQ(LogSame(Looks(0), SessionLooks()), 0);
  EXPECT_EQ(LogSame(SessionLooks(), SessionLooks()), 0);
  SessionLooks without;
  without.sightings = 5;
  EXPECT_EQ(LogSame(without, without), 0);
}

TEST(Looks, FewSightingsMayBeOfANeighbour) {
  EXPECT_GT(LogSame(Looks(0, 0, 1), Looks(1.5, 0, 30)), LogSame(Looks(0), Looks(1.5)));
  EXPECT_GT(LogSame(Looks(0, 0, 1), Looks(1.5, 0, 30)), -3);
}

TEST(Looks, ComparesTheSameSideIfBothHaveIt) {
  SessionLooks both = Looks(0);
  both.Merge(Looks(1.5, M_PI), 0);
  const LookPair pair = Compare(Looks(0), both, Symmetry::kNone);
  EXPECT_EQ(pair.cues[Cue::kEmbedding]->side, 0);
  EXPECT_NEAR(pair.cues[Cue::kEmbedding]->cosine, 1, 1e-6);
  EXPECT_EQ(Compare(Looks(0), Looks(0, M_PI), Symmetry::kNone).cues[Cue::kEmbedding]->side, 1);
  EXPECT_EQ(Compare(Looks(0), Looks(0, M_PI), Symmetry::kPi).cues[Cue::kEmbedding]->side, 0);
  EXPECT_EQ(Compare(Looks(0), Looks(0, 2), Symmetry::kFull).cues[Cue::kEmbedding]->side, 0);
}

TEST(Looks, AReversedCarIsRatherAnother) {
  SessionLooks reversed = Looks(0.8);
  std::swap(reversed.ahead, reversed.reversed);
  EXPECT_LT(LogSame(Looks(0), reversed), LogSame(Looks(0), Looks(0.8)) - 1);
  // a pole has no front
  EXPECT_EQ(LogSame(Looks(0), reversed, Symmetry::kFull),
            LogSame(Looks(0), Looks(0.8), Symmetry::kFull));
}

TEST(Looks, MergingTurnsHeadings) {
  SessionLooks looks = Looks(0);
  looks.Merge(Looks(0), M_PI);
  EXPECT_EQ(looks.ahead, 10);
  EXPECT_EQ(looks.reversed, 10);
  EXPECT_EQ(looks.sightings, 20);
  EXPECT_FALSE(Compare(looks, Looks(0), Symmetry::kNone).reversed);
}

TEST(Looks, LearnsFromValues) {
  LearntNormal normal = LearntNormal::Prior(0.5, 0.2, 4);
  EXPECT_NEAR(normal.LogDensity(0.5), -std::log(0.2 * std::sqrt(2 * M_PI)), 1e-9);
  for (int i = 0; i < 1000; ++i) normal.Add(0.9, 1);
  EXPECT_NEAR(normal.Mean(), 0.9, 0.01);
  EXPECT_GT(normal.LogDensity(0.9), normal.LogDensity(0.6) + 5);
}

}  // namespace
}  // namespace sslcd
