// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/results.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sslcd/core/error.h"
#include "temp_folder.h"

namespace sslcd::benchmark {
namespace {

class Results : public testing::Test {
 protected:
  static std::vector<Trial> Trials() {
    std::vector<Trial> trials;
    for (const std::uint64_t seed : {1, 2})
      for (const char* method : {"no_loops", "sslcd"}) {
        Trial& trial = trials.emplace_back();
        trial.case_number = 4;
        trial.seed = seed;
        trial.method = Select(Methods(), {method})[0];
      }
    return trials;
  }
  TempFolder temp_;
  const std::string path_ = temp_.path() + "/results";
};

TEST_F(Results, SameForAnyNumberOfThreadsAndNotMadeTwice) {
  const std::vector<Trial> trials = Trials();
  const ResultFolder folder(path_, "abc");
  int calls = 0;
  const auto results =
      RunTrials(trials, folder, 2, {[&](int, int total) { calls += total / 4; }, {}});
  ASSERT_TRUE(results);
  EXPECT_EQ(calls, 4);
  const auto again = RunTrials(trials, folder, 1,
                               {[](int, int) { ADD_FAILURE() << "nothing is left to do"; }, {}});
  ASSERT_TRUE(again);
  std::filesystem::remove(path_ + "/trials/" + trials[3].Name() + ".json");
  const auto anew = RunTrials(trials, ResultFolder(path_, "abc"), 1);
  ASSERT_TRUE(anew);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ((*again)[i].seconds, (*results)[i].seconds) << "read, not run";
    EXPECT_EQ((*anew)[i].ate.rmse, (*results)[i].ate.rmse);
    EXPECT_EQ((*anew)[i].loops.size(), (*results)[i].loops.size());
  }
  EXPECT_NE((*results)[0].ate.rmse, (*results)[2].ate.rmse) << "two seeds";
}

TEST_F(Results, StoppedAndContinued) {
  const std::vector<Trial> trials = Trials();
  const ResultFolder folder(path_, "abc");
  int done = 0;
  TrialHooks hooks;
  hooks.progress = [&](int now, int) { done = now; };
  hooks.stop = [&] { return done >= 1; };
  EXPECT_FALSE(RunTrials(trials, folder, 1, hooks));
  EXPECT_EQ(done, 1);
  EXPECT_TRUE(folder.Find(trials[0]));
  EXPECT_FALSE(folder.Find(trials[1]));
  int calls = 0;
  EXPECT_TRUE(RunTrials(trials, folder, 1, {[&](int, int) { ++calls; }, {}}));
  EXPECT_EQ(calls, 3);
}

TEST_F(Results, OfAnotherCommit) {
  ResultFolder(path_, "abc");
  EXPECT_NO_THROW(ResultFolder(path_, "abc"));
  try {
    ResultFolder(path_, "def");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find("results of commit abc, but this program is def"),
              std::string::npos);
  }
  EXPECT_THROW(ResultFolder(path_, "abc", "lin: {seed: 2}\n"), Error) << "other parameters";
}

TEST_F(Results, FromFilesThatMayChangeIsMeasuredAgain) {
  std::vector<Trial> trials(1, Trials()[0]);
  trials[0].method.from_files = true;
  const ResultFolder folder(path_, "abc");
  int calls = 0;
  for (int i = 0; i < 2; ++i)
    EXPECT_TRUE(RunTrials(trials, folder, 1, {[&](int, int) { ++calls; }, {}}));
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(folder.Find(trials[0])) << "for whoever wants to see each answer";
}

TEST_F(Results, TroubleEndsItAll) {
  std::vector<Trial> trials = Trials();
  trials[2].place.scene.taken_fraction = 7;
  EXPECT_THROW(RunTrials(trials, ResultFolder(path_, "abc"), 2), Error);
  trials = Trials();
  const ResultFolder folder(path_, "abc");
  std::ofstream(path_ + "/trials/" + trials[0].Name() + ".json") << "{ not json";
  EXPECT_THROW(RunTrials(trials, folder, 1), Error);
}

}  // namespace
}  // namespace sslcd::benchmark
