// SPDX-License-Identifier: BSD-3-Clause
#include "core/for_each.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace sslcd {
namespace {

TEST(ForEach, DoesEachOnceOnAnyNumberOfThreads) {
  for (int threads : {-1, 1, 4, 100}) {
    std::vector<int> times(50, 0);
    std::vector<int> told;
    ForEach(
        times.size(), threads, [&](std::size_t i) { ++times[i]; },
        [&](int done, int count) {
          told.push_back(done);
          EXPECT_EQ(count, 50);
        });
    EXPECT_EQ(times, std::vector<int>(50, 1)) << threads;
    std::vector<int> one_to_fifty(50);
    std::iota(one_to_fifty.begin(), one_to_fifty.end(), 1);
    EXPECT_EQ(told, one_to_fifty) << threads;
  }
}

TEST(ForEach, HasNothingToDoForNone) {
  ForEach(0, 4, [](std::size_t) { FAIL(); });
}

TEST(ForEach, ThrowsTheFirstProblemAndLeavesTheRest) {
  for (int threads : {1, 4}) {
    std::atomic<int> begun{0};
    const auto work = [&](std::size_t i) {
      ++begun;
      if (i == 3) throw std::runtime_error("the fourth");
      while (threads > 1 && begun < 4) std::this_thread::yield();  // so that others have begun, too
    };
    try {
      ForEach(100000, threads, work);
      ADD_FAILURE() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "the fourth");
    }
    EXPECT_LT(begun, 100000);
  }
  const auto refuse = [](int, int) { throw std::runtime_error("stop"); };
  EXPECT_THROW(ForEach(
                   3, 2, [](std::size_t) {}, refuse),
               std::runtime_error);
}

}  // namespace
}  // namespace sslcd
