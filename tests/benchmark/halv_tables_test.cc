// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/halv_tables.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sslcd::benchmark {
namespace {

ErrorStats Stats(double rmse, double std, double max) {
  ErrorStats stats;
  stats.rmse = rmse;
  stats.std = std;
  stats.max = max;
  return stats;
}

LoopOutcome Loop(bool accepted, double score, double at_m, double error_m, double viewpoint_rad) {
  return {accepted, score, at_m, error_m, 0.01, viewpoint_rad};
}

// Two keyframes to recognise, at 100 and 200 m, one from the same side, one from the other.
MethodResults TwoRuns() {
  MethodResults method;
  method.method.title = "m";
  for (const int c : {1, 2}) {
    Trial& trial = method.trials.emplace_back();
    trial.case_number = c;
    TrialResult& result = method.results.emplace_back();
    result.ate = Stats(0.1 * c, 0.05, 0.5 * c);
    result.ate_odometry = Stats(1, 0.4, 2);
    result.revisits = {{10, 1, 100, 1, 0.1, 5}, {20, 2, 200, 1, 3.1, 5}};
    result.times["loop detection"] = {4, 2, 1. * c, 3. * c, 9. * c};
  }
  method.results[0].loops = {Loop(true, 9, 101, 0.2, 0.1), Loop(false, 1, 200, 0.3, 3.1),
                             Loop(true, 2, 150, 1.5, 0.1)};
  method.results[1].loops = {Loop(true, 8, 104, 0.4, 0.1), Loop(true, 5, 199, 6., 3.1)};
  return method;
}

TEST(HalvTables, Ate) {
  const Table table = AteTable({TwoRuns()});
  ASSERT_EQ(table.rows.size(), 8u);  // the method, the odometry, six of the paper
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.header.size());
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"m", "0.100", "0.050", "0.500", "0.200",
                                                     "0.050", "1.000", "0.150", "0.200", "1.000"}));
  EXPECT_EQ(table.rows[1][1], "1.000");
  EXPECT_EQ(table.rows[7][1], "0.501") << "the paper's own, of the cases that are there";
  EXPECT_EQ(table.rows[7].back(), "0.914");
}

TEST(HalvTables, AttemptsCountWhatWasAccepted) {
  const Table table = AttemptsTable(TwoRuns(), "attempts", "t");
  ASSERT_EQ(table.rows.size(), 5u);
  const auto& same = table.rows[0];
  EXPECT_EQ(same[0], "0-45");
  EXPECT_EQ(same[1], "2");
  EXPECT_EQ(same[2], "2");
  EXPECT_EQ(same[5], "3") << "the one in between as well";
  EXPECT_EQ(same[6], "0");
  EXPECT_EQ(same[7], "1");
  EXPECT_EQ(same[8], "0.400");
  const auto& opposite = table.rows[3];
  EXPECT_EQ(opposite[2], "0") << "one was not believed, one is wrong";
  EXPECT_EQ(opposite[3], "0.000");
  EXPECT_EQ(opposite[5], "1");
  EXPECT_EQ(opposite[6], "1");
  EXPECT_EQ(opposite[8], "") << "no error of right loops where there is none";
  EXPECT_EQ(table.rows[1][3], "") << "nothing to recognise there";
  EXPECT_EQ(table.rows[4][1], "4");
  EXPECT_EQ(table.rows[4][2], "2");
}

TEST(HalvTables, LoopsOneByOne) {
  const Table table = LoopTable({TwoRuns()});
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[3][7], "6.000");
}

// By decreasing score: 9 correct, 8 correct, 5 wrong, 1 correct (refused, but an answer), of 4.
TEST(HalvTables, PrecisionAndRecallOfAllAnswers) {
  const Table table = PrecisionRecallTable({TwoRuns()});
  ASSERT_EQ(table.rows.size(), 1u);
  const auto& row = table.rows[0];
  EXPECT_EQ(row[1], "1.000");                         // same side: both, no mistake
  EXPECT_EQ(row[2], "");                              // nothing to find
  EXPECT_NEAR(std::stod(row[4]), 0.5 * 1 / 2, 1e-3);  // opposite: right once, behind a wrong one
  EXPECT_NEAR(std::stod(row[5]), 0.25 + 0.25 + 0.25 * 3 / 4, 1e-3);
  EXPECT_EQ(row[6], "4");
  EXPECT_EQ(row[7], "0.500");
  const Table curves = PrecisionRecallCurves({TwoRuns()});
  EXPECT_EQ(curves.rows.size(), 2u + 2u + 4u);
}

TEST(HalvTables, RecallOverViewpoint) {
  MethodResults method = TwoRuns();
  method.method.key = "k";
  // the very end is in the last bin
  method.results[1].revisits.push_back({30, 3, 300, 1, M_PI, 5});
  const Table table = ViewpointCurves({method}, "v");
  EXPECT_EQ(table.key, "v_curves");
  ASSERT_EQ(table.rows.size(), 2u) << "bins without a keyframe are left out";
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.header.size());
  const std::vector<std::string> same(table.rows[0].begin(), table.rows[0].begin() + 5),
      opposite(table.rows[1].begin(), table.rows[1].begin() + 5);
  EXPECT_EQ(same, (std::vector<std::string>{"k", "0-15", "2", "2", "1.000"}));
  EXPECT_EQ(opposite, (std::vector<std::string>{"k", "165-180", "3", "0", "0.000"}));
  EXPECT_GT(std::stod(table.rows[1][6]), 0.1);
  const Table side_by_side = ViewpointTable({method, method}, "v");
  EXPECT_EQ(side_by_side.header,
            (std::vector<std::string>{"viewpoint [deg]", "keyframes", "m", "m"}));
  ASSERT_EQ(side_by_side.rows.size(), 2u);
  const std::string none = "0.000 (0.000 to " + table.rows[1][6] + ")";
  EXPECT_EQ(side_by_side.rows[1], (std::vector<std::string>{"165-180", "3", none, none}));
}

TEST(HalvTables, StageTimes) {
  const Table table = StageTable(TwoRuns().results);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"loop detection", "4", "1.500", "4.50", "18.0", "1.8"}));
}

TEST(HalvTables, Ablation) {
  const Table table = AblationTable({TwoRuns()});
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"m", "0.100", "0.200", "0.150", "0.200", "0.500", "4", "1"}));
}

TEST(HalvTables, OfNothing) {
  EXPECT_EQ(AteTable({}).rows.size(), 6u);
  EXPECT_EQ(AttemptsTable({}, "a", "t").rows.size(), 5u);
  EXPECT_TRUE(LoopTable({}).rows.empty());
  EXPECT_TRUE(PrecisionRecallTable({}).rows.empty());
  EXPECT_TRUE(ViewpointTable({}, "v").rows.empty());
  EXPECT_TRUE(ViewpointCurves({}, "v").rows.empty());
  EXPECT_TRUE(StageTable({}).rows.empty());
  EXPECT_TRUE(AblationTable({}).rows.empty());
}

}  // namespace
}  // namespace sslcd::benchmark
