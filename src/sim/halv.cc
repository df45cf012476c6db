// SPDX-License-Identifier: BSD-3-Clause
#include "sim/halv.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/check_fields.h"
#include "sim/halv_course.h"
#include "sim/streams.h"
#include "sslcd/core/error.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::sim {
namespace {

OdometryNoise Scaled(OdometryNoise noise, double factor) {
  noise.heading_rad_per_sqrt_m *= factor;
  noise.tilt_rad_per_sqrt_m *= factor;
  noise.position_m_per_sqrt_m *= factor;
  noise.wander_rad_per_m *= factor;
  noise.wander_scale *= factor;
  return noise;
}

double AteOf(const Trajectory& odometry, const Trajectory& truth) {
  return ComputeAte(odometry.poses, truth.poses, Alignment::kSim3).error.rmse;
}

/// Shuffles the detections, because the order of the objects would reveal the identities.
void SortByScore(SimulatedDetections& detections) {
  const std::vector<int> identity = detections.identity;
  int row = 0;
  for (std::vector<Detection>& frame : detections.frames) {
    std::stable_sort(frame.begin(), frame.end(),
                     [](const Detection& a, const Detection& b) { return a.score > b.score; });
    for (Detection& detection : frame) {
      detections.identity[row] = identity[detection.row];
      detection.row = row++;
    }
  }
}

}  // namespace

double HalvAte(int case_number) { return HalvCaseOf(case_number).ate_m; }

DetectorNoise HalvDetector() {
  DetectorNoise noise;
  noise.sigmas = {0.1, 0.018, 0.05, 0.006, 0.05, 0.002, 0.06, 0.001, 0.05, 1};
  noise.scale = 1.85;
  noise.max_range_m = 40;
  noise.miss_rate_far = 0.6;
  noise.miss_rate_hidden = 0.5;
  noise.wrong_label = 0.02;
  return noise;
}

CalibratedOdometry SimulateOdometryWithAte(const Trajectory& truth, const OdometryNoise& shape,
                                           double ate_m, double spread, std::uint64_t seed) {
  constexpr int kDraws = 30, kRounds = 4, kPatience = 1000;
  constexpr double kLargestFactor = 20, kTolerance = 0.03;
  const auto drift = [&](double factor, int draw) {
    return SimulateOdometry(truth, Scaled(shape, factor), seed * kPatience + draw);
  };
  double factor = 1;
  for (int round = 0; round < kRounds; ++round) {  // the ATE is nearly proportional to the factor
    double sum = 0;
    for (int draw = 0; draw < kDraws; ++draw) sum += AteOf(drift(factor, draw), truth);
    factor *= ate_m * kDraws / std::max(sum, 1e-9);
    if (factor > kLargestFactor)
      throw Error(ErrorKind::kUsage,
                  "the odometry cannot drift by so much: lower --ate-m, or raise its noise");
  }
  const double wanted = ate_m * Random(seed, kDriftStream).Uniform(1 - spread, 1 + spread);
  Trajectory best;
  double nearest = std::numeric_limits<double>::infinity();
  for (int draw = 0; draw < kPatience && nearest > kTolerance * ate_m; ++draw) {
    Trajectory odometry = drift(factor, draw);
    const double off = std::abs(AteOf(odometry, truth) - wanted);
    if (off >= nearest) continue;
    nearest = off;
    best = std::move(odometry);
  }
  return {std::move(best), factor};
}

HalvSequence MakeHalv(std::uint64_t seed, const HalvOptions& options) {
  CheckFields(options.drift);
  CheckFields(options.detector);
  if (options.drift.ate_m < 0 && options.drift.ate_m != -1)
    throw Error(ErrorKind::kUsage, "ate_m is an error in metres, 0 or more, or -1: the case's");
  HalvSequence sequence;
  sequence.scene = MakeHalvWorld(seed, options.scene);
  const World& world = sequence.scene.world;
  const HalvDrift& drift = options.drift;
  constexpr std::uint64_t kVisit = 1000003;  // far from the seeds that people take
  if (options.visit < 0) throw Error(ErrorKind::kUsage, "visit is a number of a drive, 0 or more");
  const std::uint64_t noise = seed + kVisit * static_cast<std::uint64_t>(options.visit);
  const double ate = drift.ate_m < 0 ? HalvAte(options.scene.case_number) : drift.ate_m;
  if (ate == 0) {
    sequence.odometry = SimulateOdometry(world.truth, drift.shape, noise);
  } else {
    CalibratedOdometry result =
        SimulateOdometryWithAte(world.truth, drift.shape, ate, drift.ate_spread, noise);
    sequence.odometry = std::move(result.odometry);
    sequence.drift_factor = result.factor;
  }
  sequence.detections = SimulateDetections(world, options.detector, noise);
  SortByScore(sequence.detections);
  AddAppearance(world, options.appearance, seed, sequence.detections);
  return sequence;
}

void DescribeFields(FieldVisitor& visitor, HalvDrift& drift) {
  DescribeFields(visitor, drift.shape);
  visitor.Real("ate_m", drift.ate_m, -1, 1000,
               "mean ATE of the odometry over seeds, after Sim(3); -1: the case's; 0: the noise "
               "above as it is");
  visitor.Real("ate_spread", drift.ate_spread, 0, 0.5,
               "a seed's ATE differs from the mean by up to this fraction");
}

}  // namespace sslcd::sim
