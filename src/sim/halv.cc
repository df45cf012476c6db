// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/sim/halv.h"

#include "sim/check_fields.h"
#include "sim/halv_course.h"
#include "sim/streams.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::sim {
namespace {

OdometryNoise Scaled(OdometryNoise noise, double factor) {
  noise.heading_rad_per_sqrt_m *= factor;
  noise.tilt_rad_per_sqrt_m *= factor;
  noise.position_m_per_sqrt_m *= factor;
  return noise;
}

double AteOf(const Trajectory& odometry, const Trajectory& truth) {
  return ComputeAte(odometry.poses, truth.poses, Alignment::kSim3).error.rmse;
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

Trajectory SimulateOdometryWithAte(const Trajectory& truth, const OdometryNoise& shape, double ate_m,
                                   std::uint64_t seed) {
  CheckFields(shape);
  // The ATE grows with the factor, nearly in proportion: false position, kept between two bounds.
  double low = 0, high = 1;
  constexpr double kLargest = 100;
  const auto ate = [&](double factor) { return AteOf(SimulateOdometry(truth, Scaled(shape, factor), seed), truth); };
  while (ate(high) < ate_m) {
    low = high, high *= 2;
    if (high > kLargest) {
      throw Error(ErrorKind::kUsage,
                  "the odometry cannot be made to drift by so much: lower --ate-m, or raise its noise "
                  "(--heading-rad-per-sqrt-m, ...)");
    }
  }
  for (int i = 0; i < 25; ++i) {
    const double middle = 0.5 * (low + high);
    (ate(middle) < ate_m ? low : high) = middle;
  }
  return SimulateOdometry(truth, Scaled(shape, high), seed);
}

HalvSequence MakeHalv(std::uint64_t seed, const HalvOptions& options) {
  CheckFields(options.drift);
  CheckFields(options.detector);
  HalvSequence sequence;
  sequence.scene = MakeHalvWorld(seed, options.scene);
  const World& world = sequence.scene.world;
  const HalvDrift& drift = options.drift;
  if (drift.ate_m == 0) {
    sequence.odometry = SimulateOdometry(world.truth, drift.shape, seed);
  } else {
    const double mean = drift.ate_m < 0 ? HalvAte(options.scene.case_number) : drift.ate_m;
    const double factor = Random(seed, kDriftStream).Uniform(1 - drift.ate_spread, 1 + drift.ate_spread);
    sequence.odometry = SimulateOdometryWithAte(world.truth, drift.shape, mean * factor, seed);
  }
  sequence.detections = SimulateDetections(world, options.detector, seed);
  AddAppearance(world, options.appearance, seed, sequence.detections);
  return sequence;
}

void DescribeFields(FieldVisitor& visitor, HalvDrift& drift) {
  DescribeFields(visitor, drift.shape);
  visitor.Real("ate_m", drift.ate_m, -1, 1000,
               "mean ATE of the odometry over seeds, after Sim(3); -1: the case's; 0: the noise above as it is");
  visitor.Real("ate_spread", drift.ate_spread, 0, 0.9, "a seed's ATE differs from the mean by up to this fraction");
}

}  // namespace sslcd::sim
