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

/// The world: "lot", "street", either of them with "-churn", or a name of a layout file.
struct Place {
  std::string key = "lot";
  sim::HalvScene scene;
  std::vector<int> cases{};  ///< the cases of this place; empty: all
  /// ignores keyframes of the outward pass, which another place also has
  bool way_back_only = false;
};

/// One run of one method on one HALV-sim sequence.
struct Trial {
  Place place;
  int case_number = 1;
  std::uint64_t seed = 1;
  Method method;
  /// Asks the method at each attempt but closes no loop, so that all methods see the same maps; for
  /// precision and recall.
  bool only_asked = false;

  std::string World() const;  ///< e.g. "lot-c1-s7", used in file names
  std::string Name() const;   ///< e.g. "lot-c1-s7-sslcd"
};

struct TrialResult {
  ErrorStats ate, ate_se3;  ///< over all frames, after Sim(3) (as in the paper) and after SE(3) [m]
  ErrorStats ate_odometry;  ///< after Sim(3) [m]
  double scene_viewpoint_rad = 0;
  std::vector<Revisit> revisits;
  std::vector<LoopOutcome> loops;  ///< each answer, accepted or not
  std::map<std::string, StageTimes> times;
  double seconds = 0;  ///< time of the run without making the world
};

/// Runs a trial. Deterministic except for times. Throws the errors of MakeHalv and RunSequence.
TrialResult RunTrial(const Trial& trial, const sim::HalvSequence& sequence);

/// The sequence of a trial, which does not depend on the method.
sim::HalvSequence MakeSequence(const Trial& trial);

/// Conversion to and from JSON. FromJson throws Error(kBadInput); `name` replaces the file name in
/// messages.
std::string ToJson(const TrialResult& result);
TrialResult FromJson(const std::string& text, const std::string& name);

}  // namespace sslcd::benchmark
