// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "benchmark/trial.h"
#include "sslcd/core/error.h"

namespace sslcd {

// Found by nlohmann's lookup in the types' own namespace.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ErrorStats, rmse, mean, median, std, max, count)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Revisit, frame, old_frame, at_m, distance_m, viewpoint_rad,
                                   common)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoopOutcome, accepted, score, at_m, error_m, error_rad,
                                   viewpoint_rad)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StageTimes, count, mean, p50, p95, max)

namespace benchmark {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TrialResult, ate, ate_se3, ate_odometry, scene_viewpoint_rad,
                                   revisits, loops, times, seconds)

std::string ToJson(const TrialResult& result) { return nlohmann::json(result).dump(1) + "\n"; }

TrialResult FromJson(const std::string& text, const std::string& name) {
  try {
    return nlohmann::json::parse(text).get<TrialResult>();
  } catch (const nlohmann::json::exception& problem) {
    throw Error(ErrorKind::kBadInput, {name},
                std::string("is no result of a trial: ") + problem.what() +
                    "; delete it, and it is made again");
  }
}

}  // namespace benchmark
}  // namespace sslcd
