// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/background.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <vector>

namespace sslcd {
namespace {

Source<int> Count(int until, std::atomic<int>* made = nullptr) {
  return [until, made, next = 0]() mutable -> std::optional<int> {
    if (next == until) return std::nullopt;
    if (made) ++*made;
    return next++;
  };
}

TEST(Background, HandsOutEverythingInOrder) {
  for (const std::size_t ahead : {1, 3, 1000}) {
    Background<int> numbers(Count(200), ahead);
    for (int i = 0; i < 200; ++i) ASSERT_EQ(numbers.Next(), i);
    EXPECT_FALSE(numbers.Next());
    EXPECT_FALSE(numbers.Next()) << "and again";
  }
}

TEST(Background, IsNoFurtherAheadThanAllowed) {
  std::atomic<int> made = 0;
  Background<int> numbers(Count(200, &made), 3);
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(numbers.Next(), i);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_LE(made, i + 1 + 3 + 1) << "three wait, and one is in the hand";
  }
}

TEST(Background, ThrowsWhatTheSourceThrowsWhenItsTurnHasCome) {
  Background<int> numbers(
      [next = 0]() mutable -> std::optional<int> {
        if (next == 3) throw std::runtime_error("at three");
        return next++;
      },
      10);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(numbers.Next(), i);
  EXPECT_THROW(numbers.Next(), std::runtime_error);
  EXPECT_FALSE(numbers.Next());
}

TEST(Background, CanBeLeftAtAnyTime) {
  for (int taken = 0; taken < 5; ++taken) {
    auto first = std::make_unique<Background<int>>(Count(1000), 2);
    auto second = std::make_unique<Background<int>>([&] { return first->Next(); }, 2);
    for (int i = 0; i < taken; ++i) ASSERT_EQ(second->Next(), i);
    second.reset();
  }
}

}  // namespace
}  // namespace sslcd
