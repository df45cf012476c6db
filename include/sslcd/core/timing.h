// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

/// Times of one stage over a run. [ms]
struct StageTimes {
  int count = 0;
  double mean = 0, p50 = 0, p95 = 0, max = 0;
};

/// Collects the times of the calls of each stage. Not thread-safe.
class TimingTable {
 public:
  void Add(const std::string& stage, double milliseconds) {
    samples_[stage].push_back(milliseconds);
  }

  /// Adds all samples of another table.
  void Append(const TimingTable& other);

  /// One entry per stage, by name. Percentiles use the nearest rank.
  std::map<std::string, StageTimes> Summary() const;

 private:
  std::map<std::string, std::vector<double>> samples_;
};

/// Adds the time between its construction and destruction to a table.
class ScopedTimer {
 public:
  ScopedTimer(TimingTable& table, std::string stage) : table_(table), stage_(std::move(stage)) {}
  ~ScopedTimer() {
    table_.Add(stage_, std::chrono::duration<double, std::milli>(Clock::now() - start_).count());
  }
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  TimingTable& table_;
  std::string stage_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace sslcd
