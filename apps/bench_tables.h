// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "benchmark/table.h"
#include "benchmark/viewpoint.h"
#include "console.h"

namespace sslcd::apps {

struct BenchArguments {
  std::string name, out = "runs/bench", layout, kitti, docs, baselines, images, matches, report;
  int seeds = 10, threads = 0;
  bool json = false;
  std::vector<int> cases = {1, 2, 3, 4};
  std::vector<std::string> methods, trajectories, detections,
      viewpoints = benchmark::ViewpointRanges();

  bool Asks(const std::string& table) const { return name == "all" || name == table; }
};

/// What a benchmark has measured and written.
struct BenchResults {
  std::vector<benchmark::Table> tables, curves;
  std::vector<std::string> paths;
};

/// Ends a benchmark that ctrl-C has stopped.
struct BenchStopped {};

/// Measures the requested tables in the paper's order, prints them and writes them into the result
/// folder, a document and a page. Throws BenchStopped on ctrl-C; the same call continues from
/// there.
BenchResults RunBenchTables(const BenchArguments& arguments, const Console& console);

}  // namespace sslcd::apps
