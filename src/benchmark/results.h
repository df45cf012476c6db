// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmark/trial.h"

namespace sslcd::benchmark {

/// A folder with one result file per trial, so that an interrupted benchmark can continue. It never
/// mixes results of different versions of the code.
class ResultFolder {
 public:
  /// Creates the folder if necessary. Throws Error(kUsage) if it has results of another `commit` or
  /// of other parameters of the baselines, and Error(kOutput) if it cannot be written.
  ResultFolder(std::string path, const std::string& commit, const std::string& baselines_yaml = "");

  const std::string& path() const { return path_; }

  /// None: not measured yet. Throws Error(kBadInput) if the file is damaged.
  std::optional<TrialResult> Find(const Trial& trial) const;
  void Put(const Trial& trial, const TrialResult& result) const;

 private:
  std::string FileOf(const Trial& trial) const;
  std::string path_;
};

struct TrialHooks {
  /// called from any thread, never twice at the same time
  std::function<void(int done, int total)> progress;
  /// returns true to stop after the running trials; called from any thread
  std::function<bool()> stop;
};

/// Runs the trials on `threads` threads and returns their results in the same order; the number of
/// threads does not change them. Reuses results of the folder, except those of methods with
/// from_files. None: `stop` ended it early. The first exception of a trial also ends it.
std::optional<std::vector<TrialResult>> RunTrials(const std::vector<Trial>& trials,
                                                  const ResultFolder& folder, int threads,
                                                  const TrialHooks& hooks = {});

}  // namespace sslcd::benchmark
