// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmark/trial.h"

namespace sslcd::benchmark {

/// A folder with the results of trials, each in a file of its own, so that a benchmark that was
/// interrupted goes on where it stopped. Results of different versions of the code are never mixed.
class ResultFolder {
 public:
  /// Made if need be. Throws Error: kUsage where the folder holds results of another `commit` or
  /// with other parameters of the baselines, kOutput where it cannot be written.
  ResultFolder(std::string path, const std::string& commit, const std::string& baselines_yaml = "");

  const std::string& path() const { return path_; }

  /// None: not there yet. Throws Error(kBadInput) on a file that is damaged.
  std::optional<TrialResult> Find(const Trial& trial) const;
  void Put(const Trial& trial, const TrialResult& result) const;

 private:
  std::string FileOf(const Trial& trial) const;
  std::string path_;
};

struct TrialHooks {
  std::function<void(int done, int total)> progress;  ///< from any thread, one call at a time
  /// true: finish what has begun; ask from any thread
  std::function<bool()> stop;
};

/// Results of all trials, in step; those that are in the folder are not run again, but
/// Method::from_files. On `threads` threads, with the same results for any number of them. None
/// where `stop` ended it early. The first exception of a trial ends it, too.
std::optional<std::vector<TrialResult>> RunTrials(const std::vector<Trial>& trials,
                                                  const ResultFolder& folder, int threads,
                                                  const TrialHooks& hooks = {});

}  // namespace sslcd::benchmark
