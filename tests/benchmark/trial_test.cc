// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sslcd/config/config.h"
#include "sslcd/core/error.h"

namespace sslcd::benchmark {
namespace {

Trial SmallLoop(const std::string& method) {
  Trial trial;
  trial.case_number = 4;
  trial.seed = 3;
  trial.method = Select(Methods(), {method})[0];
  return trial;
}

int Accepted(const TrialResult& result) {
  int accepted = 0;
  for (const LoopOutcome& loop : result.loops) accepted += loop.accepted;
  return accepted;
}

TEST(Trial, SslcdClosesLoops) {
  const Trial trial = SmallLoop("sslcd");
  EXPECT_EQ(trial.Name(), "lot-c4-s3-sslcd");
  const TrialResult result = RunTrial(trial, MakeSequence(trial));
  EXPECT_GT(Accepted(result), 3);
  EXPECT_GT(result.revisits.size(), 3u);
  EXPECT_LT(result.ate.rmse, 0.5 * result.ate_odometry.rmse);
  EXPECT_LE(result.ate.rmse, result.ate_se3.rmse) << "Sim(3) has one freedom more";
  EXPECT_GT(result.times.at("loop detection").count, 10);
  EXPECT_GT(result.seconds, 0);
}

// Of the lane it knows it sees nothing before it is round the corner.
TEST(Trial, ACameraThatTurnsIntoAKnownLaneIsRecognisedInTheTurn) {
  const Trial trial = SmallLoop("sslcd");
  const TrialResult result = RunTrial(trial, MakeSequence(trial));
  int turning = 0;
  for (const Revisit& revisit : result.revisits) {
    if (revisit.viewpoint_rad < 1.5) continue;
    ++turning;
    EXPECT_TRUE(std::any_of(result.loops.begin(), result.loops.end(),
                            [&](const LoopOutcome& loop) {
                              return loop.accepted && loop.error_m < 1.5 &&
                                     std::abs(loop.at_m - revisit.at_m) <= 5;
                            }))
        << "at " << revisit.at_m << " m";
  }
  EXPECT_GT(turning, 0);
}

TEST(Trial, WhoIsOnlyAskedClosesNothing) {
  Trial trial = SmallLoop("one_look");
  const sim::HalvSequence sequence = MakeSequence(trial);
  trial.only_asked = true;
  EXPECT_EQ(trial.Name(), "lot-c4-s3-one_look-asked");
  const TrialResult asked = RunTrial(trial, sequence);
  const TrialResult without = RunTrial(SmallLoop("no_loops"), sequence);
  EXPECT_GT(Accepted(asked), 3) << "what would have been believed is known";
  EXPECT_NEAR(asked.ate.rmse, without.ate.rmse, 1e-9);
  EXPECT_TRUE(without.loops.empty());
}

TEST(Trial, ThroughJsonAndBack) {
  const Trial trial = SmallLoop("paper_stages");
  const TrialResult result = RunTrial(trial, MakeSequence(trial));
  const std::string text = ToJson(result);
  const TrialResult again = FromJson(text, "x.json");
  EXPECT_EQ(ToJson(again), text);
  EXPECT_EQ(again.ate.rmse, result.ate.rmse);
  ASSERT_EQ(again.loops.size(), result.loops.size());
  ASSERT_FALSE(again.loops.empty());
  EXPECT_EQ(again.loops.back().error_m, result.loops.back().error_m);
  EXPECT_EQ(again.loops.back().accepted, result.loops.back().accepted);
  ASSERT_EQ(again.revisits.size(), result.revisits.size());
  EXPECT_EQ(again.revisits.back().viewpoint_rad, result.revisits.back().viewpoint_rad);
}

TEST(Trial, DamagedJson) {
  for (const char* text : {"", "{", "[]", "{\"ate\": 3}"}) {
    try {
      FromJson(text, "x.json");
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_NE(std::string(error.what()).find("x.json: is no result"), std::string::npos)
          << error.what();
    }
  }
}

std::string Dump(Options options) {
  return DumpConfig([&](FieldVisitor& visitor) { DescribeFields(visitor, options); }, false);
}

TEST(Method, ThePaperIsAsPrintedInEveryPart) {
  EXPECT_EQ(Dump(Select(Methods(), {"paper"})[0].options), Dump(DefaultOptions(Mode::kPaper)));
  EXPECT_EQ(Dump(Select(Methods(), {"sslcd"})[0].options), Dump(DefaultOptions(Mode::kRobust)));
  const Options unrefined = Select(Methods(), {"paper_unrefined"})[0].options;
  EXPECT_EQ(unrefined.association.method, AssociationOptions::Method::kPaper);
  EXPECT_EQ(unrefined.ba.residual, BaOptions::Residual::kPaper);
  EXPECT_FALSE(unrefined.window.enabled || unrefined.refine.enabled);
}

TEST(Method, KeysAreUniqueAndSelect) {
  for (const auto& methods : {Methods(), Ablations()}) {
    std::set<std::string> keys;
    for (const Method& method : methods) EXPECT_TRUE(keys.insert(method.key).second) << method.key;
    EXPECT_EQ(methods[0].key, "sslcd");
  }
  const auto two = Select(Methods(), {"paper", "sslcd"});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].key, "paper");
  EXPECT_EQ(Select(Methods(), {}).size(), Methods().size());
  try {
    Select(Methods(), {"nobody"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'nobody'; there are: sslcd, "), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace sslcd::benchmark
