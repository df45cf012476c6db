// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace sslcd {

/// A large set of small values that finds ranges: a log-structured merge tree (O'Neil et al., 1996)
/// in memory. Changes are collected in a short list and then merged into sorted runs, each at least
/// twice as long as the next one. So changes read and write memory in sequence, O(log n) values
/// each on average; a search tree would wait for memory at random places. Nearly all values are in
/// the first run, which has no gaps. T has a flag `removed`, which its order `<` ignores.
template <class T>
class SortedRuns {
 public:
  using Range = std::pair<T, T>;  ///< values from the first one to before the second one

  SortedRuns() = default;
  /// The set of different `sorted` values.
  explicit SortedRuns(std::vector<T> sorted) { runs_.push_back(std::move(sorted)); }

  /// Adds a value that is not in the set, or removes one that is and has its flag `removed`.
  void Change(const T& value) {
    recent_.push_back(value);
    if (recent_.size() < kMostRecent) return;
    std::vector<T> run = Settled(std::move(recent_));
    recent_.clear();
    while (!runs_.empty() && runs_.back().size() < 2 * run.size()) {
      run = Merged(runs_.back(), run);
      runs_.pop_back();
    }
    runs_.push_back(std::move(run));
  }

  /// The values in the `ranges`, disjoint and ascending, that pass `test(value)`, ascending; none
  /// if there are more than `limit`.
  template <class Test>
  std::optional<std::vector<T>> Find(const std::vector<Range>& ranges, std::size_t limit,
                                     Test&& test) const {
    std::vector<T> found, here;
    for (const T& value : recent_)
      if (Contains(ranges, value) && test(value)) found.push_back(value);
    found = Settled(std::move(found));
    std::ptrdiff_t count = 0;
    for (const T& value : found) count += value.removed ? -1 : 1;
    // From the newest run to the oldest one. The latest changes of a value never add it more often
    // than all of them, so the count is a lower bound.
    for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
      here.clear();
      for (const auto& [first, last] : ranges) {
        for (auto value = std::lower_bound(run->begin(), run->end(), first);
             value != run->end() && *value < last; ++value) {
          if (!test(*value)) continue;
          here.push_back(*value);
          count += value->removed ? -1 : 1;
          if (count > static_cast<std::ptrdiff_t>(limit)) return std::nullopt;
        }
      }
      found = Merged(found, here);
    }
    return found;
  }

 private:
  static constexpr std::size_t kMostRecent = 2048;

  static bool Contains(const std::vector<Range>& ranges, const T& value) {
    if (value < ranges.front().first || !(value < ranges.back().second)) return false;
    return std::any_of(ranges.begin(), ranges.end(), [&](const Range& range) {
      return !(value < range.first) && value < range.second;
    });
  }

  // Changes of one value alternate. So two of them cancel each other.
  static std::vector<T> Merged(const std::vector<T>& a, const std::vector<T>& b) {
    std::vector<T> merged;
    merged.reserve(a.size() + b.size());
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                  std::back_inserter(merged));
    return merged;
  }

  // Sorts changes and cancels those of one value.
  static std::vector<T> Settled(std::vector<T> changes) {
    std::stable_sort(changes.begin(), changes.end());
    std::vector<T> settled;
    for (const T& change : changes) {
      if (settled.empty() || settled.back() < change)
        settled.push_back(change);
      else
        settled.pop_back();
    }
    return settled;
  }

  std::vector<std::vector<T>> runs_;  // changes; the oldest run first
  std::vector<T> recent_;             // later ones in their order
};

}  // namespace sslcd
