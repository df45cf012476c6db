// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "odometry/odometry_noise.h"
#include "sslcd/bundle/options.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/label.h"
#include "sslcd/core/pose.h"

namespace sslcd {

struct BaCamera {
  int frame = 0;
  Pose T_world_cam;
};

struct BaObject {
  int id = 0;
  Symmetry symmetry = Symmetry::kNone;
  UprightPose pose;
};

/// Object `object` was seen from camera `camera` (indices into the problem's lists).
struct BaSighting {
  int camera = 0, object = 0;
  Pose T_cam_object;
};

/// Odometry between two cameras, with the unscaled translation.
struct BaOdometry {
  int from = 0, to = 0;
  Pose T_from_to;
  OdometryFailures failures = {};  ///< between the two cameras
};

/// Another measurement of the relative pose of two cameras, e.g. from their images. It may be wrong
/// (Cauchy loss).
struct BaTie {
  int from = 0, to = 0;  ///< indices of cameras; a tie of a camera with itself is ignored
  RelativePose pose;     ///< T_from_to, metric
};

/// The prior of the remaining states after marginalisation: 0.5 |r0 + J (x - x0)|^2. The state
/// order is cameras (6 each, tangent at x0), objects (4 each), log scale (1).
struct BaPrior {
  std::vector<int> frames, object_ids;  ///< the states of the prior, by frame number and object id
  std::vector<Pose> cameras;            ///< x0
  std::vector<UprightPose> objects;     ///< x0
  double log_scale = 0;                 ///< x0
  Eigen::MatrixXd J;
  Eigen::VectorXd r0;
  bool empty() const { return J.rows() == 0; }
};

/// The prior of the slope of the road, which varies along the path. It constrains roll and pitch of
/// an odometry without gravity measurement, and thus its height, between the ends of a loop.
struct SlopePrior {
  double sigma_rad = 0;   ///< standard deviation of the slope; 0: no prior
  double length_m = 200;  ///< path length over which the slope is constant
};

struct BaProblem {
  GravityFrame gravity;
  std::vector<BaCamera> cameras;
  std::vector<BaObject> objects;
  std::vector<BaSighting> sightings;
  std::vector<BaOdometry> odometry;
  std::vector<BaTie> ties;
  double log_scale = 0;
  double expected_log_scale = 0;  ///< mean of the scale's prior if `prior` is empty
  BaPrior prior;                  ///< empty: the first camera and the scale get default priors
  /// Fixes the first camera also with a prior, because the prior of a long path hardly constrains
  /// the position in the world.
  bool hold_first = false;
  DetectionNoise noise;
  NoiseScale noise_scale;
  OdometryFactors odometry_factors;  ///< factors on BaOptions::odometry
  /// The first camera defines the up direction of the cameras; it is on a slope like all others.
  SlopePrior slope;
};

/// Eq. 7: moves cameras, objects and scale to the minimum. Deterministic for any thread count.
/// Never throws: a problem without sightings and ties, or with input that is not finite, stays
/// unchanged and `usable` is false.
BaSummary SolveBa(BaProblem& problem, const BaOptions& options);

/// Computes the prior that replaces the given cameras and objects (sorted indices) and all their
/// residuals, linearised at the current states (Schur complement). Every other object must be seen
/// from at least one remaining camera.
BaPrior Marginalise(const BaProblem& problem, const std::vector<int>& cameras,
                    const std::vector<int>& objects, const BaOptions& options);

/// Estimates the factor of the detector's scatter around the map relative to `problem.noise`, per
/// component, from the median of the absolute residuals. Keeps the current scale with fewer than 20
/// residuals.
NoiseScale EstimateNoiseScale(const BaProblem& problem);

}  // namespace sslcd
