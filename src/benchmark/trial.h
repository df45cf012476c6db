// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "benchmark/method.h"
#include "eval/revisits.h"
#include "sim/halv.h"
#include "sslcd/core/timing.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::benchmark {

/// Which world: "lot", "street", either of them with a "-churn", or a name for a layout file.
struct Place {
  std::string key = "lot";
  sim::HalvScene scene;
  std::vector<int> cases{};  ///< the only ones it is for; empty: all
  /// keyframes on the way out do not count, for another place has the same
  bool way_back_only = false;
};

/// One run of one method on one HALV-sim sequence.
struct Trial {
  Place place;
  int case_number = 1;
  std::uint64_t seed = 1;
  Method method;
  /// The method is asked at each attempt, but closes nothing: all methods see the same maps. For
  /// precision and recall.
  bool only_asked = false;

  std::string World() const;  ///< e.g. "lot-c1-s7", for files
  std::string Name() const;   ///< e.g. "lot-c1-s7-sslcd"
};

struct TrialResult {
  ErrorStats ate, ate_se3;  ///< of all frames, after Sim(3) (the paper's) and after SE(3) [m]
  ErrorStats ate_odometry;  ///< after Sim(3) [m]
  double scene_viewpoint_rad = 0;
  std::vector<Revisit> revisits;
  std::vector<LoopOutcome> loops;  ///< each answer, accepted or not
  std::map<std::string, StageTimes> times;
  double seconds = 0;  ///< the run, without making the world
};

/// Deterministic but for times. Throws what MakeHalv and RunSequence throw.
TrialResult RunTrial(const Trial& trial, const sim::HalvSequence& sequence);

/// The sequence of a trial, whatever its method.
sim::HalvSequence MakeSequence(const Trial& trial);

/// As JSON, and back. FromJson throws Error(kBadInput), `name` stands for the file.
std::string ToJson(const TrialResult& result);
TrialResult FromJson(const std::string& text, const std::string& name);

}  // namespace sslcd::benchmark
