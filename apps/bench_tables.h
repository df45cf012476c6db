// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "benchmark/viewpoint.h"
#include "console.h"

namespace sslcd::apps {

struct BenchArguments {
  std::string name, out = "runs/bench", layout, kitti, docs, baselines, images, matches;
  int seeds = 10, threads = 0;
  std::vector<int> cases = {1, 2, 3, 4};
  std::vector<std::string> methods, trajectories, detections,
      viewpoints = benchmark::ViewpointRanges();
};

/// Ends a benchmark that ctrl-C has stopped.
struct BenchStopped {};

/// Runs the tables that are asked for, in the order of the paper's, prints them and writes them
/// into the result folder. Throws BenchStopped on ctrl-C; the same call goes on from there.
void RunBenchTables(const BenchArguments& arguments, const Console& console);

}  // namespace sslcd::apps
