// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/results.h"

#include <atomic>
#include <filesystem>
#include <mutex>
#include <utility>

#include "core/for_each.h"
#include "formats/atomic_file.h"
#include "formats/files.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd::benchmark {
namespace {

std::optional<std::string> ReadIfThere(const std::string& path) {
  if (IfFile(path).empty()) return std::nullopt;
  return ReadFileBytes(path);
}

}  // namespace

ResultFolder::ResultFolder(std::string path, const std::string& commit,
                           const std::string& baselines_yaml)
    : path_(std::move(path)) {
  const std::string way_out = "; give another --out, or delete the folder to start again";
  MakeWritableFolder(path_);
  MakeWritableFolder(path_ + "/trials");
  const auto known = ReadIfThere(path_ + "/commit.txt");
  if (known && *known != commit + "\n")
    throw Error(ErrorKind::kUsage, path_ + " holds results of commit " +
                                       known->substr(0, known->find('\n')) +
                                       ", but this program is " + commit + way_out);
  const auto baselines = ReadIfThere(path_ + "/baselines.yaml");
  if (baselines && *baselines != baselines_yaml)
    throw Error(ErrorKind::kUsage,
                path_ + " holds results with other parameters of the baselines" + way_out);
  WriteFileAtomically(path_ + "/commit.txt", commit + "\n");
  WriteFileAtomically(path_ + "/baselines.yaml", baselines_yaml);
}

std::string ResultFolder::FileOf(const Trial& trial) const {
  return path_ + "/trials/" + trial.Name() + ".json";
}

std::optional<TrialResult> ResultFolder::Find(const Trial& trial) const {
  const auto text = ReadIfThere(FileOf(trial));
  if (!text) return std::nullopt;
  return FromJson(*text, FileOf(trial));
}

void ResultFolder::Put(const Trial& trial, const TrialResult& result) const {
  WriteFileAtomically(FileOf(trial), ToJson(result));
}

std::optional<std::vector<TrialResult>> RunTrials(const std::vector<Trial>& trials,
                                                  const ResultFolder& folder, int threads,
                                                  const TrialHooks& hooks) {
  std::vector<TrialResult> results(trials.size());
  std::vector<std::vector<std::size_t>> missing;  // by world, so that each world is made once
  std::map<std::string, std::size_t> worlds;
  int done = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (auto found = trials[i].method.from_files ? std::nullopt : folder.Find(trials[i])) {
      results[i] = std::move(*found);
      ++done;
      continue;
    }
    const auto [world, is_new] = worlds.insert({trials[i].World(), missing.size()});
    if (is_new) missing.emplace_back();
    missing[world->second].push_back(i);
  }

  std::atomic<bool> stopped{false};
  std::mutex one_at_a_time;
  ForEach(missing.size(), threads, [&](std::size_t world) {
    std::optional<sim::HalvSequence> sequence;
    for (const std::size_t i : missing[world]) {
      if (hooks.stop && hooks.stop()) stopped = true;
      if (stopped) return;
      if (!sequence) sequence = MakeSequence(trials[i]);
      try {
        results[i] = RunTrial(trials[i], *sequence);
        folder.Put(trials[i], results[i]);
      } catch (...) {  // stops the other threads after their trial
        stopped = true;
        throw;
      }
      const std::lock_guard<std::mutex> lock(one_at_a_time);
      ++done;
      if (hooks.progress) hooks.progress(done, static_cast<int>(trials.size()));
    }
  });
  if (stopped) return std::nullopt;
  return results;
}

}  // namespace sslcd::benchmark
