// SPDX-License-Identifier: BSD-3-Clause
#include "eval/precision_recall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

TEST(PrecisionRecallTest, ByHand) {
  const PrecisionRecall result =
      ComputePrecisionRecall({{0.4, true, 0}, {0.9, true, 0}, {0.7, false, 0}, {0.8, true, 0}}, 5);
  ASSERT_EQ(result.curve.size(), 4u);
  EXPECT_EQ(result.positives, 5);
  EXPECT_EQ(result.curve[0].threshold, 0.9);
  EXPECT_DOUBLE_EQ(result.curve[1].recall, 0.4);
  EXPECT_DOUBLE_EQ(result.curve[2].precision, 2. / 3);
  EXPECT_DOUBLE_EQ(result.curve[3].precision, 0.75);
  EXPECT_DOUBLE_EQ(result.curve[3].recall, 0.6);
  EXPECT_EQ(result.curve[3].answered, 4);
  EXPECT_EQ(result.curve[3].correct, 3);
  EXPECT_DOUBLE_EQ(result.average_precision, 0.2 + 0.2 + 0.2 * 0.75);
  EXPECT_DOUBLE_EQ(result.recall_at_full_precision, 0.4);
  EXPECT_DOUBLE_EQ(result.curve[3].precision_interval.low, WilsonInterval(3, 4).low);
  EXPECT_DOUBLE_EQ(result.curve[3].recall_interval.high, WilsonInterval(3, 5).high);
}

TEST(PrecisionRecallTest, EqualScoresCannotBeToldApart) {
  const PrecisionRecall result =
      ComputePrecisionRecall({{1, true, 0}, {1, false, 0}, {1, true, 0}}, 2);
  ASSERT_EQ(result.curve.size(), 1u);
  EXPECT_DOUBLE_EQ(result.curve[0].precision, 2. / 3);
  EXPECT_DOUBLE_EQ(result.average_precision, 2. / 3);
  EXPECT_EQ(result.recall_at_full_precision, 0);
}

TEST(PrecisionRecallTest, AllRightAllWrongNothing) {
  EXPECT_DOUBLE_EQ(ComputePrecisionRecall({{3, true, 0}, {2, true, 0}}, 2).average_precision, 1);
  EXPECT_DOUBLE_EQ(ComputePrecisionRecall({{3, true, 0}, {2, true, 0}}, 2).recall_at_full_precision,
                   1);
  EXPECT_EQ(ComputePrecisionRecall({{3, false, 0}, {2, false, 0}}, 2).average_precision, 0);
  EXPECT_TRUE(ComputePrecisionRecall({}, 4).curve.empty());
  const PrecisionRecall nothing_to_find = ComputePrecisionRecall({{3, false, 0}}, 0);
  EXPECT_EQ(nothing_to_find.curve[0].recall, 0);
  EXPECT_EQ(nothing_to_find.curve[0].recall_interval.high, 1);
}

TEST(PrecisionRecallTest, TheOrderOfTheAnswersDoesNotMatter) {
  std::mt19937 random(1);
  std::vector<ScoredAnswer> answers;
  for (int i = 0; i < 200; ++i)
    answers.push_back({static_cast<double>(random() % 20), random() % 3 > 0, 0});
  const PrecisionRecall a = ComputePrecisionRecall(answers, 200);
  std::shuffle(answers.begin(), answers.end(), random);
  const PrecisionRecall b = ComputePrecisionRecall(answers, 200);
  ASSERT_EQ(a.curve.size(), 20u);
  ASSERT_EQ(b.curve.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(a.curve[i].correct, b.curve[i].correct);
    EXPECT_GE(a.curve[i].recall, i > 0 ? a.curve[i - 1].recall : 0.);
  }
  EXPECT_EQ(a.average_precision, b.average_precision);
}

TEST(PrecisionRecallTest, Nonsense) {
  EXPECT_THROW(ComputePrecisionRecall({{1, true, 0}}, 0), Error);
  EXPECT_THROW(ComputePrecisionRecall({}, -1), Error);
  EXPECT_THROW(ComputePrecisionRecall({{std::nan(""), true, 0}}, 1), Error);
  EXPECT_THROW(ComputePrecisionRecallByViewpoint({{1, true, std::nan("")}}, {1, 1, 1, 1}), Error);
}

TEST(ViewpointBinTest, EdgesSignsAndTurns) {
  const auto bin = [](double degrees) { return ViewpointBin(degrees * M_PI / 180); };
  EXPECT_EQ(bin(0), 0);
  EXPECT_EQ(bin(44.9), 0);
  EXPECT_EQ(bin(-45.1), 1);
  EXPECT_EQ(bin(100), 2);
  EXPECT_EQ(bin(180), 3);
  EXPECT_EQ(bin(-180), 3);
  EXPECT_EQ(bin(190), 3);
  EXPECT_EQ(bin(350), 0);
  EXPECT_EQ(bin(-3 * 360 + 60), 1);
}

TEST(PrecisionRecallByViewpointTest, SplitsAnswersAndPositives) {
  const auto results = ComputePrecisionRecallByViewpoint(
      {{1, true, 0.1}, {2, false, -0.1}, {3, true, 3.1}}, {1, 0, 0, 2});
  EXPECT_EQ(results[0].curve.size(), 2u);
  EXPECT_DOUBLE_EQ(results[0].average_precision, 0.5);
  EXPECT_TRUE(results[1].curve.empty());
  EXPECT_DOUBLE_EQ(results[3].recall_at_full_precision, 0.5);
}

}  // namespace
}  // namespace sslcd
