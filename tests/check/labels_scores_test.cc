// SPDX-License-Identifier: BSD-3-Clause
#include "check/labels_scores.h"

#include <gmock/gmock.h>

#include "drive.h"

namespace sslcd::check {
namespace {

using testing::ElementsAre;

TEST(Scores, PerCentAndLogits) {
  Sequence s = MakeDrive();
  EXPECT_EQ(IdOf(CheckScores(s)), "ok");
  for (Row& row : s.rows) row.written.score = 90;
  EXPECT_THAT(BeforeAndAfter(CheckScores, s), ElementsAre("score_percent", "ok"));
  for (Row& row : s.rows) row.written.score = 15;
  EXPECT_EQ(IdOf(CheckScores(s)), "ok");
  s.rows.front().written.score = -40;
  s.rows.back().written.score = 40;
  EXPECT_EQ(IdOf(CheckScores(s)), "ok");
  s.rows.resize(19);
  EXPECT_EQ(IdOf(CheckScores(s)), "not testable");
}

TEST(Labels, Spelling) {
  Sequence s = MakeDrive();
  EXPECT_EQ(IdOf(CheckLabels(s)), "ok");
  for (Row& row : s.rows) row.detection.label = "cars";
  EXPECT_THAT(BeforeAndAfter(CheckLabels, s), ElementsAre("unknown_labels", "ok"));
  for (Row& row : s.rows) row.detection.label = "Bus";
  EXPECT_EQ(IdOf(CheckLabels(s)), "ok");
  s.labels = {};
  EXPECT_EQ(IdOf(CheckLabels(s)), "not testable");
}

TEST(Symmetry, RoundObjectsAndHeadingsByChance) {
  Sequence s = MakeDrive();
  EXPECT_EQ(IdOf(CheckSymmetry(s)), "ok");
  ChangeCuboids(s, [](FileCuboid& c) {
    c.w = c.l;
    c.rotation_y = 0;
  });
  EXPECT_THAT(BeforeAndAfter(CheckSymmetry, s), ElementsAre("no_symmetry", "ok"));
  s = MakeDrive();
  double turn = 0;
  ChangeCuboids(s, [&](FileCuboid& c) { c.rotation_y = WrapAngle(turn += 2.3); });
  EXPECT_THAT(BeforeAndAfter(CheckSymmetry, s), ElementsAre("no_symmetry", "ok"));
  s.rows.resize(29);
  EXPECT_EQ(IdOf(CheckSymmetry(s)), "not testable");
}

}  // namespace
}  // namespace sslcd::check
