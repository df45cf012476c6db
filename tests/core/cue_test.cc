// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/cue.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace sslcd {
namespace {

TEST(Cues, NamesAndFilesAreThoseOfTheFormats) {
  EXPECT_STREQ(kCueRows[0].name, "colour");
  EXPECT_STREQ(kCueRows[0].file, "colours.npy");
  EXPECT_TRUE(kCueRows[0].complete) << "gaps would be filled from images";
  EXPECT_STREQ(kCueRows[1].name, "embedding");
  EXPECT_STREQ(kCueRows[1].file, "embeddings.npy");
  EXPECT_FALSE(kCueRows[1].complete);
}

TEST(Cues, AForgottenOrMisplacedRowIsNoticed) {
  constexpr CueRow kForgotten[] = {kCueRows[0]}, kSwapped[] = {kCueRows[1], kCueRows[0]},
                   kTwice[] = {kCueRows[0], kCueRows[1], kCueRows[1]};
  EXPECT_TRUE(OneRowPerCue(kCueRows));
  EXPECT_FALSE(OneRowPerCue(kForgotten));
  EXPECT_FALSE(OneRowPerCue(kSwapped));
  EXPECT_FALSE(OneRowPerCue(kTwice));
}

TEST(Cues, EachRowIsWhole) {
  std::set<std::string> names, files;
  for (const CueRow& row : kCueRows) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(names.insert(row.name).second) << "there are two of this name";
    EXPECT_TRUE(files.insert(row.file).second) << "there are two of this file";
    ASSERT_NE(row.weight, nullptr);
    for (const double lambda : {0., 0.3, 0.5, 1.}) {
      EXPECT_GE(row.weight(lambda), 0);
      EXPECT_LE(row.weight(lambda), 1);
    }
    EXPECT_GT(row.cosine.sigma, 0);
    EXPECT_LE(row.cosine.other_object, row.cosine.opposite_side);
    EXPECT_LE(row.cosine.opposite_side, row.cosine.same_side);
    EXPECT_GT(row.cosine.same_side, row.cosine.other_object) << "the cue would tell nothing";
    EXPECT_GT(row.limit_share.value_or(1), 0);
    EXPECT_LE(row.limit_share.value_or(1), 1);
  }
}

TEST(PerCue, HasOneValueForEachCue) {
  PerCue<int> numbers;
  for (const CueRow& row : kCueRows) EXPECT_EQ(numbers[row.cue], 0);
  numbers[Cue::kEmbedding] = 3;
  EXPECT_EQ(numbers[Cue::kColour], 0);
  EXPECT_EQ(numbers[Cue::kEmbedding], 3);
  PerCue<int> copy = numbers;
  EXPECT_TRUE(copy == numbers);
  copy[Cue::kColour] = 1;
  EXPECT_TRUE(copy != numbers);
}

TEST(PerCue, StartsWithTheSameValueEverywhere) {
  const PerCue<std::string> each(std::string("unknown"));
  for (const CueRow& row : kCueRows) EXPECT_EQ(each[row.cue], "unknown");
}

}  // namespace
}  // namespace sslcd
