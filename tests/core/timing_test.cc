// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/core/timing.h"

#include <gtest/gtest.h>

namespace sslcd {
namespace {

TEST(TimingTable, PercentilesAreNearestRanks) {
  TimingTable table;
  for (int i = 100; i >= 1; --i) table.Add("stage", i);
  table.Add("other", 7);
  const auto summary = table.Summary();
  EXPECT_EQ(summary.at("stage").count, 100);
  EXPECT_EQ(summary.at("stage").p50, 50);
  EXPECT_EQ(summary.at("stage").p95, 95);
  EXPECT_EQ(summary.at("stage").max, 100);
  EXPECT_EQ(summary.at("stage").mean, 50.5);
  EXPECT_EQ(summary.at("other").p50, 7);
}

TEST(TimingTable, AppendPutsSamplesTogether) {
  TimingTable table, other;
  table.Add("both", 1);
  table.Add("mine", 2);
  other.Add("both", 5);
  other.Add("theirs", 3);
  table.Append(other);
  table.Append({});
  const auto summary = table.Summary();
  EXPECT_EQ(summary.size(), 3u);
  EXPECT_EQ(summary.at("both").count, 2);
  EXPECT_EQ(summary.at("both").mean, 3);
  EXPECT_EQ(summary.at("mine").count, 1);
  EXPECT_EQ(summary.at("theirs").max, 3);
  EXPECT_EQ(other.Summary().at("both").count, 1) << "nothing was taken away";
}

TEST(ScopedTimer, AddsOneSample) {
  TimingTable table;
  { const ScopedTimer timer(table, "stage"); }
  ASSERT_EQ(table.Summary().at("stage").count, 1);
  EXPECT_GE(table.Summary().at("stage").max, 0);
  EXPECT_TRUE(TimingTable().Summary().empty());
}

}  // namespace
}  // namespace sslcd
