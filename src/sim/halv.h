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

/// The world and the path of HALV-sim. The paper's data set (HALV) is not public; docs/halv_sim.md
/// describes the model.
struct HalvScene {
  int case_number = 1;         ///< 1 rectangle, 2 straight out and back, 3 curve, 4 small loop
  std::string layout = "lot";  ///< "lot", "street", or a JSON file of parked cars
  /// change of heading between the two passes where they meet; -1: that of the case
  double viewpoint_low_deg = -1, viewpoint_high_deg = -1;
  /// factor on the length of the straight parts of the path
  double size = 1;
  double speed_mps = 2;
  double keyframe_hz = 3;
  double taken_fraction = 0.6;  ///< share of occupied stalls in generated layouts
  /// share of the parked vehicles, if the layout does not define it
  double van_fraction = 0.08, truck_fraction = 0.03;
  bool marks = true;  ///< poles and trees in generated layouts
  /// share of the parked vehicles that is replaced before the second pass
  double churn = 0;
  int driving_cars = 2;     ///< number of driving cars; every second one is oncoming
  double render_scale = 1;  ///< 1: images of 1280x720
};
void DescribeFields(FieldVisitor& visitor, HalvScene& scene);

/// The drift of the odometry.
struct HalvDrift {
  /// the errors relative to each other
  OdometryNoise shape{0.01, 5e-4, 5e-5, 4e-3, 5e-4, 0.015, 40};
  /// mean ATE over seeds, after Sim(3); -1: that of the case; 0: uses `shape` unchanged
  double ate_m = -1;
  double ate_spread = 0.15;  ///< largest relative difference of one seed's ATE from the mean
};
void DescribeFields(FieldVisitor& visitor, HalvDrift& drift);

/// The noise of a stereo detector with a mean single-frame 3D IoU of .45.
DetectorNoise HalvDetector();

struct HalvOptions {
  HalvScene scene;
  HalvDrift drift;
  DetectorNoise detector = HalvDetector();
  AppearanceNoise appearance;
  /// the number of the drive through the world of the seed, from 0 on: each has another noise of
  /// odometry and detections, and sees the same objects on the same path
  int visit = 0;
};

/// A place for one vehicle, occupied or free: its centre in the world and its heading from +z
/// towards +x.
struct ParkingSpace {
  double x = 0, z = 0, heading = 0;
  double length_m = 0, width_m = 0;
};

struct HalvWorld {
  World world;
  /// path length of the outward pass; changes between the passes happen there
  int return_frame = 0;
  double viewpoint_rad = 0;  ///< change of heading between the two passes where they meet
  /// removed vehicles of a layout file: on the path, or overlapping another one
  int left_out = 0;
  std::vector<ParkingSpace> spaces;
};

/// Makes world and path. The same seed gives the same world. Throws Error(kUsage) if a value is out
/// of range, the path leaves the lot or has no cars beside it, and Error(kBadInput) for a malformed
/// layout file.
HalvWorld MakeHalvWorld(std::uint64_t seed, const HalvScene& scene = {});

/// Replaces the share `scene.churn` of the vehicles in the parking spaces from a frame on by
/// others, each at the same place or at a free one.
void ReplaceVehicles(const HalvScene& scene, std::uint64_t seed, int frame, HalvWorld& world);

/// A complete sequence for WriteSequence.
struct HalvSequence {
  HalvWorld scene;
  Trajectory odometry;
  double drift_factor = 1;  ///< factor on the errors of HalvDrift::shape
  SimulatedDetections detections;
};
HalvSequence MakeHalv(std::uint64_t seed, const HalvOptions& options = {});

/// Makes odometry with the requested drift: the errors of `shape`, except the scale error, times a
/// factor that gives a mean ATE after Sim(3) of `ate_m` over draws. Takes a draw whose ATE is near
/// a random value from ate_m (1 -+ spread). So few seeds suffice for the mean, and the steps have
/// the same noise for all seeds. Throws Error(kUsage) if there is no such factor.
struct CalibratedOdometry {
  Trajectory odometry;
  double factor = 1;
};
CalibratedOdometry SimulateOdometryWithAte(const Trajectory& truth, const OdometryNoise& shape,
                                           double ate_m, double spread, std::uint64_t seed);

/// Mean ATE of uncorrected odometry over seeds, which the paper reports for VINS-Fusion. [m]
double HalvAte(int case_number);

}  // namespace sslcd::sim
