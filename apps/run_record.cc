// SPDX-License-Identifier: BSD-3-Clause
#include "run_record.h"

#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>

#include "commands.h"
#include "core/command_line.h"
#include "core/utc_time.h"
#include "datasets/run_folder.h"
#include "formats/files.h"
#include "sslcd/core/error.h"
#include "sslcd/version.h"

namespace sslcd::apps {
namespace {

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
}

const auto g_start = std::chrono::steady_clock::now();
const std::string g_started = UtcTime();

bool AreImages(const std::string& role) { return role.find("images") != std::string::npos; }

// The words that make the result.
std::vector<std::string> Relevant(std::vector<std::string> words) {
  static const std::set<std::string> kIrrelevant = {"--force",  "--json",   "-q",
                                                    "--quiet",  "-v",       "--verbose",
                                                    "--resume", "--report", "--no-images"};
  if (!words.empty()) words.erase(words.begin());
  words.erase(std::remove_if(words.begin(), words.end(),
                             [](const std::string& word) { return kIrrelevant.count(word) > 0; }),
              words.end());
  const auto threads = std::find(words.begin(), words.end(), "--threads");
  if (words.end() - threads >= 2) words.erase(threads, threads + 2);
  return words;
}

}  // namespace

RunRecord RecordRun(const Dataset& dataset,
                    const std::vector<std::pair<std::string, std::string>>& others,
                    const Console& console) {
  RunRecord record;
  record.version = SSLCD_VERSION;
  record.commit = Commit();
  record.command = CommandWords();
  record.dataset = dataset.name;
  record.format = dataset.format;
  record.labels = dataset.labels;
  record.camera = dataset.camera;
  record.started = g_started;
  std::vector<std::pair<std::string, std::string>> inputs = dataset.parts;
  inputs.insert(inputs.end(), others.begin(), others.end());
  for (const auto& [role, path] : inputs) {
    if (path.empty()) continue;
    record.inputs.push_back(RecordFile(path, !AreImages(role)));
    record.inputs.back().role = role;
    if (AreImages(role))  // reports read them, from whatever folder
      record.inputs.back().name = std::filesystem::absolute(path).lexically_normal().string();
  }
  record.warnings = console.Warnings();
  record.cpu_s = CpuSeconds();
  record.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - g_start).count();
  return record;
}

void RefuseOtherRun(const std::string& folder) {
  const std::string way_out = "; name another folder with --out, or replace it with --force";
  const std::string path = (std::filesystem::path(folder) / "run.json").string();
  if (IfFile(path).empty()) {
    for (const std::string& file : RunFolderPaths(folder))
      if (IsFile(file))
        throw Error(ErrorKind::kUsage, folder + ": has " + LastName(file) +
                                           ", but no run.json that says of which run" + way_out);
    return;
  }
  const RunRecord record = ReadRunJson(path);
  if (Relevant(record.command) == Relevant(CommandWords())) return;
  throw Error(ErrorKind::kUsage, folder + ": holds the run '" + CommandLine(record.command) +
                                     "' of " + record.started + way_out);
}

}  // namespace sslcd::apps
