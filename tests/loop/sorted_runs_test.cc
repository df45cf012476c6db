// SPDX-License-Identifier: BSD-3-Clause
#include "loop/sorted_runs.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace sslcd {
namespace {

struct Number {
  int value = 0;
  bool removed = false;
  bool operator<(const Number& other) const { return value < other.value; }
};

std::vector<int> ValuesOf(const std::vector<Number>& numbers) {
  std::vector<int> values;
  for (const Number& number : numbers) {
    EXPECT_FALSE(number.removed);
    values.push_back(number.value);
  }
  return values;
}

TEST(SortedRuns, FindWhatASetHas) {
  std::mt19937 random(1);
  std::set<int> expected;
  std::vector<Number> sorted;
  for (int i = 0; i < 4000; i += 2) {
    expected.insert(i);
    sorted.push_back({i});
  }
  SortedRuns<Number> runs(sorted);
  for (int change = 1; change <= 60000; ++change) {
    const int value = static_cast<int>(random() % 5000);
    const bool known = expected.count(value) > 0;
    if (known)
      expected.erase(value);
    else
      expected.insert(value);
    runs.Change({value, known});
    if (change % 977 != 0) continue;
    const int from = static_cast<int>(random() % 2000);
    const std::vector<SortedRuns<Number>::Range> ranges = {{{from}, {from + 700}},
                                                           {{from + 1000}, {from + 2500}}};
    std::vector<int> wanted;
    for (const int i : expected)
      if (((i >= from && i < from + 700) || (i >= from + 1000 && i < from + 2500)) && i % 3 != 0)
        wanted.push_back(i);
    const auto test = [](const Number& number) { return number.value % 3 != 0; };
    const auto found = runs.Find(ranges, wanted.size(), test);
    ASSERT_TRUE(found) << "as many as the limit";
    ASSERT_EQ(ValuesOf(*found), wanted);
    ASSERT_FALSE(runs.Find(ranges, wanted.size() - 1, test)) << "more than the limit";
  }
}

TEST(SortedRuns, MayLoseAllValues) {
  SortedRuns<Number> runs;
  const auto all = [&] {
    return ValuesOf(*runs.Find({{{0}, {100000}}}, 100000, [](const Number&) { return true; }));
  };
  EXPECT_TRUE(all().empty());
  for (int i = 0; i < 20000; ++i) runs.Change({i});
  EXPECT_EQ(all().size(), 20000u);
  for (int i = 0; i < 20000; ++i) runs.Change({i, true});
  EXPECT_TRUE(all().empty());
  for (int i = 0; i < 10; ++i) {
    runs.Change({7});
    EXPECT_EQ(all(), std::vector<int>{7});
    runs.Change({7, true});
    EXPECT_TRUE(all().empty());
  }
}

}  // namespace
}  // namespace sslcd
