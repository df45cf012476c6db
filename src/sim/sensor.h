// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sim/world.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/pose.h"

namespace sslcd::sim {

/// The errors of visual odometry: a wrong scale, random walks that grow with the square root of the
/// distance, and errors that change slowly.
struct OdometryNoise {
  /// relative error of the length of every step (real stereo odometry: about 3 %)
  double scale_error = 0.03;
  double heading_rad_per_sqrt_m = 5e-4;
  double tilt_rad_per_sqrt_m = 5e-5;    ///< roll and pitch
  double position_m_per_sqrt_m = 4e-3;  ///< each axis
  // Slowly varying bias with the correlation length `wander_m`.
  double wander_rad_per_m = 0;  ///< of the heading
  double wander_scale = 0;      ///< of the scale
  double wander_m = 40;
};
void DescribeFields(FieldVisitor& visitor, OdometryNoise& noise);

/// Simulates odometry T_odom_cam with the stamps of `truth`; the first pose is the identity. Steps
/// without motion get no noise.
Trajectory SimulateOdometry(const Trajectory& truth, const OdometryNoise& noise,
                            std::uint64_t seed);

/// The errors of a 3D object detector.
struct DetectorNoise {
  /// position, yaw and size, growing with range; its initial_scale is not used here
  DetectionNoise sigmas;
  double scale = 1.;  ///< factor on all of `sigmas`
  /// share of the variance that is common to all sightings of an object
  double constant_fraction = 0.5;
  double flip_rate = 0.03;   ///< probability of a reversed heading
  double box_sigma_px = 2.;  ///< each side of the 2D box
  double max_range_m = 60.;
  double miss_rate_near = 0.03;  ///< probability of missing a visible object at range 0
  double miss_rate_far = 0.5;    ///< probability of missing a visible object at the maximal range
  /// additional probability of missing an almost hidden object; half of it for a half hidden one
  double miss_rate_hidden = 0;
  /// smallest share of a visible object that lies in the image and is not hidden
  double min_visible = 0.25;
  /// probability of a confused label (car and van, pole and tree), if the world has both classes
  double wrong_label = 0;
  double false_positives = 0.2;  ///< mean number per frame
};
void DescribeFields(FieldVisitor& visitor, DetectorNoise& noise);

/// All detections of a sequence; `row` counts through all frames.
struct SimulatedDetections {
  std::vector<std::vector<Detection>> frames;
  std::vector<int> identity;  ///< true WorldObject::id of every row; -1: false positive
};

/// Simulates the detections of `world` along its true path. Position errors are drawn in the
/// camera's ray frame (RayFrame), so a constant one rotates with the viewing direction. Objects of
/// symmetry `full` get a random yaw. The same seed gives the same detections.
SimulatedDetections SimulateDetections(const World& world, const DetectorNoise& noise,
                                       std::uint64_t seed);

/// Combines odometry and detections to frames, like a dataset reader.
std::vector<Frame> MakeFrames(const Trajectory& odometry, const SimulatedDetections& detections);

}  // namespace sslcd::sim
