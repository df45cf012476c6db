// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/foreign.h"

#include "sslcd/core/error.h"
#include "sslcd/formats/poses.h"

namespace sslcd::benchmark {

ErrorStats ForeignAte(const std::string& file, const Trajectory& truth) {
  constexpr double kLeastShare = 0.9;
  const PoseFile estimate = ReadPoseFile(file);
  if (estimate.format == PoseFormat::kKitti)
    throw Error(ErrorKind::kBadInput, {file},
                "its rows have no stamps; write them as TUM does: t x y z qx qy qz qw");
  MatchedPoses matched;
  try {
    matched = MatchByStamp(estimate.trajectory, truth);
  } catch (const Error& problem) {
    throw Error(ErrorKind::kBadInput, {file}, problem.what());
  }
  if (static_cast<double>(matched.est.size()) < kLeastShare * static_cast<double>(truth.size()))
    throw Error(ErrorKind::kBadInput, {file},
                "has poses for " + std::to_string(matched.est.size()) + " of " +
                    std::to_string(truth.size()) +
                    " frames: check that it is of this case and seed, and a pose a frame");
  return ComputeAte(matched.est, matched.ref, Alignment::kSim3).error;
}

}  // namespace sslcd::benchmark
