// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "sim/appearance.h"
#include "sim/sensor.h"
#include "sim/world.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/pose.h"

namespace sslcd::sim {

/// Where HALV-sim drives. The data set of the paper (HALV) is not public; docs/halv_sim.md says
/// what is modelled.
struct HalvScene {
  int case_number = 1;         ///< 1 rectangle, 2 straight out and back, 3 curve, 4 small loop
  std::string layout = "lot";  ///< "lot", "street", or a JSON file of parked cars
  /// between the two passes where they meet; -1: the case's
  double viewpoint_low_deg = -1, viewpoint_high_deg = -1;
  /// factor on the straight parts of the path
  double size = 1;
  double speed_mps = 2;
  double keyframe_hz = 3;
  double taken_fraction = 0.6;  ///< of the generated stalls
  /// of the parked vehicles, where the layout does not say
  double van_fraction = 0.08, truck_fraction = 0.03;
  bool marks = true;  ///< poles and trees in generated layouts
  /// share of the parked vehicles that has gone, and been replaced, at the second pass
  double churn = 0;
  int driving_cars = 2;     ///< every second one is oncoming
  double render_scale = 1;  ///< 1: images of 1280x720
};
void DescribeFields(FieldVisitor& visitor, HalvScene& scene);

/// How far the odometry drifts.
struct HalvDrift {
  /// which errors, relative to each other
  OdometryNoise shape{0.01, 5e-4, 5e-5, 4e-3, 5e-4, 0.015, 40};
  /// mean ATE over seeds, after Sim(3); -1: the case's; 0: `shape` as given
  double ate_m = -1;
  double ate_spread = 0.15;  ///< one seed's ATE differs from that by up to this fraction
};
void DescribeFields(FieldVisitor& visitor, HalvDrift& drift);

/// Noise of a stereo detector whose mean single-frame 3D IoU is .45.
DetectorNoise HalvDetector();

struct HalvOptions {
  HalvScene scene;
  HalvDrift drift;
  DetectorNoise detector = HalvDetector();
  AppearanceNoise appearance;
};

/// A place for one vehicle, taken or free: where its middle is in the world and which way it faces,
/// from +z towards +x.
struct ParkingSpace {
  double x = 0, z = 0, heading = 0;
  double length_m = 0, width_m = 0;
};

struct HalvWorld {
  World world;
  /// the way out ends here; what changed between the passes changes here
  int return_frame = 0;
  double viewpoint_rad = 0;  ///< between the two passes where they meet
  /// vehicles of a layout file that stood in the way or twice in the same place
  int left_out = 0;
  std::vector<ParkingSpace> spaces;
};

/// World and path. Same seed, same world. Throws Error: kUsage (a value out of range, the path
/// leaves the lot, no cars beside it), kBadInput (the layout file).
HalvWorld MakeHalvWorld(std::uint64_t seed, const HalvScene& scene = {});

/// Everything that WriteSequence needs.
struct HalvSequence {
  HalvWorld scene;
  Trajectory odometry;
  double drift_factor = 1;  ///< on the errors of HalvDrift::shape
  SimulatedDetections detections;
};
HalvSequence MakeHalv(std::uint64_t seed, const HalvOptions& options = {});

/// Odometry that drifts as told: the errors of `shape`, scale error excepted, times one factor with
/// which the ATE after Sim(3) is `ate_m` in the mean over draws. Of these draws one is taken whose
/// own ATE is near a value drawn from ate_m (1 -+ spread), so that few seeds suffice for the mean
/// while every step errs as much as with any other seed. Throws Error(kUsage) where no factor does
/// it.
struct CalibratedOdometry {
  Trajectory odometry;
  double factor = 1;
};
CalibratedOdometry SimulateOdometryWithAte(const Trajectory& truth, const OdometryNoise& shape,
                                           double ate_m, double spread, std::uint64_t seed);

/// ATE of odometry that is never corrected, mean over seeds: what the paper reports of VINS-Fusion.
/// [m]
double HalvAte(int case_number);

}  // namespace sslcd::sim
